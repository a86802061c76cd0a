//! The studies, as libraries and as processes: one binary of tests, for each one more
//! links all of them again.

use std::process::{Command, Output};

mod command_lines;
mod ensembles;
mod solvers;
mod stability_map;
mod swaying_branch;
mod tree_thresholds;
mod work_precision;

/// Runs a program to its end.
fn run(program: &str, arguments: &[&str]) -> Output {
    Command::new(program).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}
