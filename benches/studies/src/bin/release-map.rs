//! Growth of the antiphase mode over the plane of releases.
//!
//! `release-map --help` lists the options.

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use branched_pendulum_studies::release_map;

fn main() -> ExitCode {
    frame::main(release_map::run)
}
