//! Energy and its flux through the generations of a driven tree.
//!
//! `cascade --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::cascade;
use branched_pendulum_program::frame;

fn main() -> ExitCode {
    frame::main(cascade::run)
}
