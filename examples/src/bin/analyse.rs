//! H_d and W of the paper's pendulum from measured angles, with their errors.
//!
//! `analyse --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::analyse;
use branched_pendulum_program::frame;

fn main() -> ExitCode {
    frame::main(analyse::run)
}
