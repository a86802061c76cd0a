//! Program that maps the steps and motions for which each method fails.
//!
//! `stability-map --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::stability_map;

fn main() -> ExitCode {
    frame::main(stability_map::run)
}
