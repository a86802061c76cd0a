//! Derivations of one user keep out of each other's way: real processes.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// A folder of this test's own, removed at the end.
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

/// The tool, deriving the paper's pendulum, for a user with this home.
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

/// The lock of a user with this home, held as by a process that derives all the time, and the
/// file in which that process says who it is.
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
    // A file where the home should be: no user, root neither, can write below it.
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
        fs::write(&note, text).expect("likewise");
        std::thread::sleep(Duration::from_millis(500));
    }
    drop(held);
    let output = finished(child);
    let errors = errors(&output);
    assert!(output.status.success(), "{errors}");
    let notice = "waiting for the derivation of process 7 (package `busy`)\n";
    assert!(errors.contains(notice), "{errors}");
    // Each derivation tells itself apart.
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

    // Once it is let go the next one derives.
    let mut command = derivation(&home);
    let child = command.spawn().expect("the tool starts");
    std::thread::sleep(Duration::from_millis(200));
    drop(held);
    let output = finished(child);
    assert!(output.status.success(), "{}", self::errors(&output));
}
