//! Program that measures the cost of a given error for each method.
//!
//! `work-precision --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::work_precision;

fn main() -> ExitCode {
    frame::main(work_precision::run)
}
