//! Program that finds the angles of release from which on small differences grow in trees given by
//! a rule.
//!
//! `tree-thresholds --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::tree_thresholds;

fn main() -> ExitCode {
    frame::main(tree_thresholds::run)
}
