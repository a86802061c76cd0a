//! From which releases on small differences grow in trees by rule.
//!
//! `tree-thresholds --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::tree_thresholds;

fn main() -> ExitCode {
    frame::main(tree_thresholds::run)
}
