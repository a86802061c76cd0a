use super::{FolderLock, LOCK, part_name};
use crate::failure::Failure;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

fn temporary(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn one_holds_a_folder_at_a_time() {
    let folder = temporary("one-run");
    let (within, runs) = (AtomicU32::new(0), AtomicU32::new(0));
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while runs.load(Ordering::SeqCst) < 200 {
                    match FolderLock::take(&folder, "test") {
                        Ok(lock) => {
                            assert_eq!(within.fetch_add(1, Ordering::SeqCst), 0);
                            runs.fetch_add(1, Ordering::SeqCst);
                            assert_eq!(within.fetch_sub(1, Ordering::SeqCst), 1);
                            drop(lock);
                        }
                        Err(Failure::Busy { .. }) => {}
                        Err(failure) => panic!("{failure:?}"),
                    }
                }
            });
        }
    });
    assert_eq!(names(&folder), [""; 0]);
    fs::remove_dir_all(&folder).unwrap();
}

/// Puts the folder into the state that a killed run leaves: a lock file exists, but no process
/// holds it.
fn killed(folder: &Path) -> String {
    let lock = FolderLock::take(folder, "test").unwrap();
    let left = fs::read(folder.join(LOCK)).unwrap();
    let stamp = lock.stamp.clone();
    drop(lock);
    fs::write(folder.join(LOCK), left).unwrap();
    stamp
}

#[test]
fn part_files_of_a_killed_run_go_and_nothing_else() {
    let folder = temporary("killed-run");
    let stamp = killed(&folder);
    let others = [
        ".a.csv.part".to_owned(),
        ".film.mp4.12.part".to_owned(),
        ".download.2026.part".to_owned(),
        "a.csv.12.part".to_owned(),
        format!("a.csv.{stamp}.part"),
        format!(".{stamp}.part"),
        format!(".a.csv.{stamp}"),
        part_name("a.csv", "0123456789abcdef"),
        part_name(LOCK, "0123456789abcdef"),
        "notes.txt".to_owned(),
    ];
    let own = ["a.csv", "checkpoint", "run.json"].map(|name| part_name(name, &stamp));
    for name in others.iter().chain(&own) {
        fs::write(folder.join(name), "text").unwrap();
    }
    // Another run was killed before its lock file had its name.
    let left = fs::read_to_string(folder.join(LOCK)).unwrap();
    let early = "fedcba9876543210";
    let left = left.replace(&stamp, early);
    fs::write(folder.join(part_name(LOCK, early)), left).unwrap();
    drop(FolderLock::take(&folder, "test").unwrap());
    let mut expected = others.to_vec();
    expected.sort_unstable();
    assert_eq!(names(&folder), expected);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn files_that_a_killed_run_had_finished_are_known() {
    use std::io::Write;
    let folder = temporary("finished");
    let lock = FolderLock::take(&folder, "test").unwrap();
    for (name, digest) in [("a.csv", "12"), ("b c.csv", "34"), ("a.csv", "56")] {
        let line = super::entry(name, digest);
        lock.journal().unwrap().write_all(line.as_bytes()).unwrap();
    }
    let left = fs::read(folder.join(LOCK)).unwrap();
    drop(lock);
    // Of the last line half was written.
    fs::write(folder.join(LOCK), [&left[..], b"file 78"].concat()).unwrap();
    let lock = FolderLock::take(&folder, "test").unwrap();
    let names: Vec<_> = lock.finished.keys().map(String::as_str).collect();
    assert_eq!(names, ["a.csv", "b c.csv"]);
    assert_eq!(lock.finished["a.csv"].len(), 2);
    drop(lock);
    assert_eq!(self::names(&folder), [""; 0]);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_foreign_file_of_this_name_is_refused_and_stays() {
    let folder = temporary("foreign-lock");
    let path = folder.join(LOCK);
    for text in [
        "",
        "thesis",
        "branched-pendulum run 2\n",
        "branched-pendulum run 1\n",
        "\u{ff}",
    ] {
        fs::write(&path, text).unwrap();
        let refused = FolderLock::take(&folder, "test").unwrap_err();
        assert!(matches!(&refused, Failure::File { path: named, .. } if *named == path));
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
        assert_eq!(names(&folder), [LOCK]);
    }
    fs::remove_dir_all(&folder).unwrap();
}
