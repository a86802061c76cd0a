//! Program that draws accuracy against cost of compiled models.
//!
//! `accuracy-cost --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::accuracy_cost;

fn main() -> ExitCode {
    frame::main(accuracy_cost::run)
}
