//! Files in the folder that the cache did not write.

use super::{Folder, own};
use crate::cache::entry::CacheEntry;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use std::fs::{self, File, Permissions};
use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _, PermissionsExt as _, symlink};
use std::os::unix::net::UnixListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, SystemTime};

/// Number of files that the cache writes in a test, and the number that may remain.
const WRITTEN: usize = 20;
const STAY: usize = 6;

/// Number of kinds of foreign files that [`place`] creates.
const KINDS: u64 = 12;

fn temporary(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("{name}-{}", std::process::id()));
    fs::create_dir_all(&path).unwrap();
    fs::set_permissions(&path, Permissions::from_mode(0o700)).unwrap();
    path
}

/// Writes an old file with the given permissions.
fn write(path: &Path, text: &str, mode: u32) {
    fs::write(path, text).unwrap();
    fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
    let old = SystemTime::now() - Duration::from_secs(100_000_000);
    File::options()
        .append(true)
        .open(path)
        .unwrap()
        .set_modified(old)
        .unwrap();
}

/// Creates a foreign file of the given kind: it has the name of a cache file or the text of a cache
/// file, but not both.
fn install(folder: &Path, outside: &Path, kind: u64, random: &mut SplitMix64) {
    let number = (random.next_u64() % (3 * WRITTEN as u64)) as usize;
    let (name, text) = own(number);
    let named = folder.join(&name);
    if fs::symlink_metadata(&named).is_ok() {
        return;
    }
    match kind {
        0 => write(&named, "diary\n", 0o600),
        1 => write(&named, "", 0o600),
        2 => write(
            &named,
            &text.replacen("expansion ", "expansion: ", 1),
            0o600,
        ),
        3 => write(&named, &text[..40], 0o600),
        4 => write(&named, &text, 0o664),
        5 => {
            fs::create_dir(&named).unwrap();
            write(&named.join(&name), &text, 0o600);
        }
        6 => {
            let whole = outside.join(&name);
            write(&whole, &text, 0o600);
            symlink(whole, named).unwrap();
        }
        7 => symlink("/dev/zero", named).unwrap(),
        8 => symlink(outside.join("missing"), named).unwrap(),
        9 => assert!(
            Command::new("mkfifo")
                .arg(named)
                .status()
                .unwrap()
                .success()
        ),
        10 => drop(UnixListener::bind(named).unwrap()),
        _ => {
            let names = [
                format!("diary-{number}.txt"),
                format!("{name}.bak"),
                format!("{name}.{number}"),
                name.to_uppercase(),
                format!("0{name}"),
                name.replace(".expansion", ""),
            ];
            let name = &names[(random.next_u64() % names.len() as u64) as usize];
            write(&folder.join(name), &text, 0o600);
        }
    }
}

/// Lists everything that a folder holds, as text.
fn seen(folder: &Path) -> Vec<String> {
    let mut lines = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let data = fs::symlink_metadata(&path).unwrap();
        let content = match data.file_type() {
            kind if kind.is_dir() => seen(&path).join(", "),
            kind if kind.is_symlink() => format!("{:?}", fs::read_link(&path).unwrap()),
            kind if kind.is_fifo() || kind.is_socket() => String::new(),
            _ => fs::read_to_string(&path).unwrap(),
        };
        let [mode, time, length] = [u64::from(data.mode()), data.mtime() as u64, data.size()];
        lines.push(format!("{path:?} {mode:o} {time} {length} {content}"));
    }
    lines.sort();
    lines
}

#[test]
fn stays_untouched_in_a_hundred_folders() {
    let outside = temporary("outside");
    for seed in 0..100 {
        let path = temporary(&format!("foreign-{seed}"));
        let mut random = SplitMix64::seed_from_u64(seed);
        for _ in 0..5 + random.next_u64() % 30 {
            let kind = random.next_u64() % KINDS;
            install(&path, &outside, kind, &mut random);
        }
        let (before, elsewhere) = (seen(&path), seen(&outside));
        let foreign: Vec<String> = names(&path);
        let folder = Folder {
            path: path.clone(),
            most: (STAY, 1 << 20),
        };
        for number in 0..WRITTEN {
            let (name, text) = own(number);
            let is_foreign = foreign.contains(&name);
            folder.write(&name, &text);
            assert_eq!(
                folder.read(&name),
                (!is_foreign).then_some(text),
                "{seed} {name}"
            );
        }
        // No question leads to the other names.
        for name in foreign
            .iter()
            .filter(|name| CacheEntry::is_name(name.as_ref()))
        {
            assert_eq!(folder.read(name), None, "{seed} {name}");
        }
        let own: Vec<String> = names(&path)
            .into_iter()
            .filter(|name| !foreign.contains(name))
            .collect();
        assert_eq!(own.len(), STAY, "{seed}");
        for name in own {
            assert!(CacheEntry::is_name(name.as_ref()));
            fs::remove_file(path.join(name)).unwrap();
        }
        assert_eq!(seen(&path), before, "{seed}");
        assert_eq!(seen(&outside), elsewhere, "{seed}");
        fs::remove_dir_all(path).unwrap();
    }
    fs::remove_dir_all(outside).unwrap();
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

#[test]
fn is_not_believed_where_others_may_write() {
    let path = temporary("others");
    let folder = Folder::new(path.clone());
    let (name, text) = own(0);
    let planted = path.join(&name);
    write(&planted, &text, 0o600);
    assert_eq!(folder.read(&name).as_ref(), Some(&text));
    for mode in [0o620, 0o602, 0o666, 0o664] {
        fs::set_permissions(&planted, Permissions::from_mode(mode)).unwrap();
        assert_eq!(folder.read(&name), None, "{mode:o}");
    }
    fs::set_permissions(&planted, Permissions::from_mode(0o600)).unwrap();
    for mode in [0o720, 0o702, 0o777, 0o775, 0o1777] {
        fs::set_permissions(&path, Permissions::from_mode(mode)).unwrap();
        assert_eq!(folder.read(&name), None, "{mode:o}");
        folder.write(&own(1).0, &own(1).1);
        assert_eq!(names(&path), std::slice::from_ref(&name), "{mode:o}");
    }
    fs::set_permissions(&path, Permissions::from_mode(0o755)).unwrap();
    assert_eq!(folder.read(&name).as_ref(), Some(&text));
    // Only the superuser can give files away.
    if std::os::unix::fs::chown(&planted, Some(12345), None).is_ok() {
        assert_eq!(folder.read(&name), None);
        fs::remove_file(&planted).unwrap();
        folder.write(&name, &text);
        assert_eq!(folder.read(&name).as_ref(), Some(&text));
        std::os::unix::fs::chown(&path, Some(12345), None).unwrap();
        assert_eq!(folder.read(&name), None);
    }
    fs::remove_dir_all(path).unwrap();
}

/// Independent of the umask of the process.
#[test]
fn has_no_part_in_what_the_cache_makes() {
    let path = temporary("modes").join("a/b");
    let folder = Folder::new(path.clone());
    folder.write(&own(0).0, &own(0).1);
    let mode = |path: &Path| fs::metadata(path).unwrap().mode() & 0o777;
    assert_eq!([mode(&path), mode(&path.join(own(0).0))], [0o700, 0o600]);
    fs::remove_dir_all(temporary("modes")).unwrap();
}
