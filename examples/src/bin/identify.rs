//! Parameters of a pendulum from its measured motion, with their errors.
//!
//! `identify --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::identify;
use branched_pendulum_program::frame;

fn main() -> ExitCode {
    frame::main(identify::run)
}
