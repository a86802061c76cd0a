//! Where each method fails.
//!
//! `stability-map --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::stability_map;
use branched_pendulum_program::frame;

fn main() -> ExitCode {
    frame::main(stability_map::run)
}
