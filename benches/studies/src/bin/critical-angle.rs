//! At which releases of the paper's pendulum its antiphase mode grows.
//!
//! `critical-angle --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::critical_angle;

fn main() -> ExitCode {
    frame::main(critical_angle::run)
}
