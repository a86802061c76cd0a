//! Energy of a driven binary tree, sector by sector.
//!
//! `energy-cascade --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::{energy_cascade, program};

fn main() -> ExitCode {
    program::main(energy_cascade::run)
}
