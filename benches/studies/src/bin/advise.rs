//! Program that finds the cheapest model, method, setting and scalar type.
//!
//! `advise --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::advise;

fn main() -> ExitCode {
    frame::main(advise::run)
}
