//! `integration-speed`: its problems, and its command line.

use std::process::Command;

use branched_pendulum::prelude::*;
use branched_pendulum_examples::integration_speed::measure::points;
use branched_pendulum_examples::solvers::scenes::{Ideal, Rods};
use branched_pendulum_examples::work_precision::reference::problems;

/// The error goes down with the tolerance to where it is said to.
#[test]
fn errors_fall_to_rounding() {
    let problems = problems().unwrap();
    let named = |name| problems.iter().find(|p| p.name == name).unwrap();
    let (regular, rods) = (named("regular, 10 s"), named("seven rods, 10 s"));
    let method = |tolerance| Taylor::new(Options::with_tolerance(tolerance));
    for points in [
        points(&AbsoluteAngles(&Ideal::new()), regular, 1, method).unwrap(),
        points(&AbsoluteAngles(&Rods::new()), rods, 1, method).unwrap(),
    ] {
        assert!(points[0].error > 1e-4, "{points:?}");
        let least = points
            .iter()
            .fold(1.0_f64, |least, point| least.min(point.error));
        assert!(least < 5e-14, "{least:e}");
    }
}

#[test]
fn a_command_line_that_cannot_be_followed_is_explained() {
    let program = env!("CARGO_BIN_EXE_integration-speed");
    let wrong = Command::new(program).arg("--output").output().unwrap();
    assert_eq!(wrong.status.code(), Some(2));
    let help = Command::new(program).arg("--help").output().unwrap();
    assert!(help.status.success());
    let help = String::from_utf8(help.stdout).unwrap();
    assert!(help.contains("Usage: integration-speed"));
}
