//! Derivations in several processes of one user wait for each other. The test runs real processes.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// A temporary folder of this test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lock-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("the folder for temporary files is writable");
        Self(path)
    }

    fn sub(&self, name: &str) -> PathBuf {
        let path = self.0.join(name);
        fs::create_dir_all(&path).expect("the folder is this test's own");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Returns a command that derives the paper's pendulum, for a user with this home folder.
fn derivation(home: &Path) -> Command {
    let scene =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/fixtures/scenes/paper.rs");
    let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-branched-pendulum"));
    command
        .args(["stage".as_ref(), "mechanics".as_ref(), scene.as_os_str()])
        .env("HOME", home)
        .env_remove("XDG_CACHE_HOME")
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command
}

/// Takes the lock of a user with this home folder, as a process does that derives all the time.
/// Returns the lock, and the file in which that process names itself.
#[cfg(target_os = "linux")]
fn held(home: &Path) -> (File, PathBuf) {
    let own = home.join(".cache/branched-pendulum");
    fs::create_dir_all(&own).expect("the folder is this test's own");
    let held = File::create(own.join("derivation.lock")).expect("likewise");
    held.lock().expect("nobody else knows it");
    (held, own.join("derivation.holder"))
}

fn finished(child: Child) -> Output {
    child.wait_with_output().expect("the tool runs")
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn processes_with_other_temporary_folders_do_not_abort_each_other() {
    let folder = Folder::new("temporary");
    let home = folder.sub("home");
    let started: Vec<Child> = (0..8)
        .map(|number| {
            let temporary = folder.sub(&format!("tmp{number}"));
            let mut command = derivation(&home);
            command.env("TMPDIR", temporary);
            command.spawn().expect("the tool starts")
        })
        .collect();
    for child in started {
        let output = finished(child);
        assert!(output.status.success(), "{}", errors(&output));
    }
}

#[test]
fn a_home_that_cannot_be_written_is_an_error_with_its_remedy() {
    let folder = Folder::new("home");
    // A file instead of the home folder: no user, not even root, can create files below it.
    let home = folder.0.join("home");
    fs::write(&home, "").expect("the folder is this test's own");
    let output = finished(derivation(&home).spawn().expect("the tool starts"));
    let errors = errors(&output);
    assert!(
        output.status.code().is_some_and(|code| code != 0),
        "{errors}"
    );
    assert!(errors.contains("cannot write and lock"), "{errors}");
    assert!(errors.contains("set HOME"), "{errors}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_process_of_many_derivations_is_waited_for() {
    let folder = Folder::new("many");
    let home = folder.sub("home");
    let (held, note) = held(&home);
    let mut command = derivation(&home);
    command.env("BRANCHED_PENDULUM_WAIT", "2");
    let child = command.spawn().expect("the tool starts");
    for number in 0..8 {
        let text = format!("process 7 (package `busy`)\n{number}");
        // Whoever reads the note finds it whole.
        let written = folder.0.join("note");
        fs::write(&written, text).expect("the folder is this test's own");
        fs::rename(&written, &note).expect("the folder is this test's own");
        std::thread::sleep(Duration::from_millis(500));
    }
    drop(held);
    let output = finished(child);
    let errors = errors(&output);
    assert!(output.status.success(), "{errors}");
    let notice = "waiting for the derivation of process 7 (package `busy`)\n";
    assert!(errors.contains(notice), "{errors}");
    // Each derivation identifies itself.
    let note = fs::read_to_string(note).expect("likewise");
    let lines: Vec<&str> = note.lines().collect();
    assert!(
        lines.len() == 2 && lines[0].starts_with("process "),
        "{note}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn nobody_waits_for_ever_and_who_waits_says_for_whom() {
    let folder = Folder::new("suspended");
    let home = folder.sub("home");
    let (held, note) = held(&home);
    fs::write(note, "process 7 (package `slow`)").expect("likewise");
    let start = Instant::now();
    let mut command = derivation(&home);
    command.env("BRANCHED_PENDULUM_WAIT", "4");
    let output = finished(command.spawn().expect("the tool starts"));
    let (errors, waited) = (errors(&output), start.elapsed());
    assert!(
        output.status.code().is_some_and(|code| code != 0),
        "{errors}"
    );
    let notice = "waiting for the derivation of process 7 (package `slow`)";
    assert!(errors.contains(notice), "{errors}");
    assert!(errors.contains("for more than 4 s"), "{errors}");
    assert!(errors.contains("BRANCHED_PENDULUM_WAIT"), "{errors}");
    assert!(
        waited > Duration::from_secs(4) && waited < Duration::from_secs(60),
        "{waited:?}"
    );

    // Once the lock is released, the next process derives.
    let mut command = derivation(&home);
    let child = command.spawn().expect("the tool starts");
    std::thread::sleep(Duration::from_millis(200));
    drop(held);
    let output = finished(child);
    assert!(output.status.success(), "{}", self::errors(&output));
}

/// Links, pipes and files of others have the names that derivations use: all stay as they are.
#[cfg(unix)]
#[test]
fn files_of_others_stay_as_they_are() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("foreign");
    let thesis = folder.0.join("thesis.tex");
    fs::write(&thesis, "\\chapter{One}\n").expect("the folder is this test's own");
    let place = |kind: &str, path: &Path| match kind {
        "link" => symlink(&thesis, path).expect("likewise"),
        "hard link" => fs::hard_link(&thesis, path).expect("likewise"),
        "pipe" => {
            let made = Command::new("mkfifo").arg(path).status();
            assert!(made.is_ok_and(|status| status.success()));
        }
        kind => fs::write(path, kind).expect("likewise"),
    };
    for (number, kind) in ["link", "hard link", "pipe", "diary"]
        .into_iter()
        .enumerate()
    {
        for (name, derives) in [("derivation.lock", false), ("derivation.holder", true)] {
            let home = folder.sub(&format!("home-{number}-{name}"));
            let own = home.join(".cache/branched-pendulum");
            fs::create_dir_all(&own).expect("likewise");
            let path = own.join(name);
            place(kind, &path);
            let before = fs::symlink_metadata(&path)
                .expect("it is there")
                .file_type();
            let output = finished(derivation(&home).spawn().expect("the tool starts"));
            let errors = errors(&output);
            assert_eq!(output.status.success(), derives, "{kind} {name}: {errors}");
            assert!(
                derives || errors.contains("cannot write and lock"),
                "{errors}"
            );
            let after = fs::symlink_metadata(&path)
                .expect("it is there")
                .file_type();
            assert_eq!(before, after);
            let text = fs::read_to_string(&thesis).expect("it is there");
            assert_eq!(text, "\\chapter{One}\n", "{kind} {name}");
            if kind == "diary" {
                assert_eq!(fs::read_to_string(&path).expect("it is there"), "diary");
            }
        }
    }
}

/// The sandbox of a package manager names a home that does not exist: it is not created.
#[cfg(target_os = "linux")]
#[test]
fn a_missing_home_is_not_created() {
    let folder = Folder::new("homeless");
    let temporary = folder.sub("tmp");
    for missing in ["homeless-shelter", "a/b/c", "nonexistent"] {
        let home = folder.0.join(missing);
        let mut command = derivation(&home);
        command.env("TMPDIR", &temporary);
        let output = finished(command.spawn().expect("the tool starts"));
        assert!(output.status.success(), "{}", errors(&output));
        let first = folder.0.join(missing.split('/').next().unwrap_or(missing));
        assert!(!home.exists() && !first.exists());
    }
    // A cache folder that is named is created, wherever it is.
    let cache = folder.0.join("cache");
    let mut command = derivation(&folder.0.join("nonexistent"));
    command.env("XDG_CACHE_HOME", &cache);
    assert!(
        finished(command.spawn().expect("the tool starts"))
            .status
            .success()
    );
    assert!(cache.join("branched-pendulum").exists());
}
