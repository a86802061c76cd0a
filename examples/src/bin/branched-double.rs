//! The paper's experiment, from the release to tables and charts.
//!
//! `branched-double --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::{branched_double, program};

fn main() -> ExitCode {
    program::main(branched_double::run::run)
}
