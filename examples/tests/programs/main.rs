//! The paper's experiment, as a library and as a process, and the short programs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

mod branched_double;
mod experiment;
mod short;
mod template;

/// Runs a program to its end.
fn run(program: &str, arguments: &[&str]) -> Output {
    Command::new(program).args(arguments).output().unwrap()
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
