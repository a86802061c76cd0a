//! A branch in the wind, by models from the full one to a few modes.
//!
//! `swaying-branch --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::swaying_branch;

fn main() -> ExitCode {
    frame::main(swaying_branch::run)
}
