//! `integration-speed`: its problems, and its command line.

use std::process::Command;

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::prelude::*;
use branched_pendulum_examples::integration_speed::ensemble::near_threshold;
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

/// In lanes, an emitted model goes where it goes alone. Only 3 s: a deviation
/// grows up to 3e7 times in 10 s there, and in 5 s up to 1e6 times where links spin.
#[test]
fn lanes_agree_with_the_plain_method_near_the_threshold() {
    let (model, starts) = (Ideal::new(), near_threshold(101));
    let options = Options::with_tolerance(1e-11);
    let (method, series) = (Dop853::new(options.clone()), Taylor::new(options));
    let ensemble = Ensemble::new();
    let plain = ensemble.integrate(&method, &AbsoluteAngles(&model), &starts, 3.0);
    let lanes = ensemble.integrate_in_lanes(&method, &model, &starts, 3.0);
    let series = ensemble.integrate_in_lanes(&series, &model, &starts, 3.0);
    for (plain, lanes) in plain.into_iter().zip(lanes.into_iter().zip(series)) {
        let plain = plain.unwrap().state;
        for lane in [lanes.0, lanes.1].map(|lane| lane.unwrap().state) {
            for (a, b) in plain.values.iter().zip(&lane.values) {
                assert!((a - b).abs() < 1e-6, "{plain:?} {lane:?}");
            }
        }
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
