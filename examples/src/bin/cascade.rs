//! Energy and its flux through the generations of a driven tree.
//!
//! `cascade --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_examples::{cascade, program};

fn main() -> ExitCode {
    program::main(cascade::run)
}
