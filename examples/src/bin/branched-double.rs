//! The paper's experiment, from the release to tables and charts.
//!
//! `branched-double --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::branched_double;
use branched_pendulum_frame as frame;

fn main() -> ExitCode {
    frame::main(branched_double::run)
}
