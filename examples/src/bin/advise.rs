//! Which model, method, setting and scalar to take.
//!
//! `advise --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::{advise, program};

fn main() -> ExitCode {
    program::main(advise::run)
}
