//! How wrong each form of the energy transfer W is, and what it costs.
//!
//! `transfer-orders --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::transfer_orders;
use branched_pendulum_program::frame;

fn main() -> ExitCode {
    frame::main(transfer_orders::run)
}
