//! At which releases of the paper's pendulum its antiphase mode grows.
//!
//! `critical-angle --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::{critical_angle, program};

fn main() -> ExitCode {
    program::main(critical_angle::run)
}
