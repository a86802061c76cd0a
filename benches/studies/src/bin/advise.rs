//! Which model, method, setting and scalar to take.
//!
//! `advise --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::advise;
use branched_pendulum_program::frame;

fn main() -> ExitCode {
    frame::main(advise::run)
}
