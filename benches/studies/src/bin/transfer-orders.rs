//! How wrong each form of the energy transfer W is, and what it costs.
//!
//! `transfer-orders --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::transfer_orders;

fn main() -> ExitCode {
    frame::main(transfer_orders::run)
}
