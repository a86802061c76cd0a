//! Program that simulates a branch in the wind with several models, from the full equations to a
//! few linear modes.
//!
//! `swaying-branch --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::swaying_branch;

fn main() -> ExitCode {
    frame::main(swaying_branch::run)
}
