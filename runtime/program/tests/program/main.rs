//! The command as a process.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

mod identify;
mod measured;

/// Runs the command with these words to its end.
fn run(words: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_branched-pendulum");
    Command::new(program).args(words).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// A folder for one test that is not there yet.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    path
}
