//! The reference trajectories of the paper's pendulum.

use branched_pendulum::prelude::*;
use serde_json::Value;

use crate::problems::BranchedDouble;

fn reference() -> Value {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../tests/fixtures/reference/trajectories.json"
    );
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// An exact decimal, in degrees where the text says so.
fn angle(text: &str) -> f64 {
    match text.strip_suffix(" degrees") {
        Some(degrees) => degrees.parse::<f64>().unwrap().to_radians(),
        None => text.parse().unwrap(),
    }
}

fn numbers(values: &Value) -> impl Iterator<Item = f64> {
    values
        .as_array()
        .unwrap()
        .iter()
        .map(|value| angle(value.as_str().unwrap()))
}

/// Largest error at each of the times, in rad and rad/s, of `run`, which visits
/// the absolute angles and velocities at the times.
fn errors(problem: &str, run: impl FnOnce(&[f64], &mut dyn FnMut(f64, &[f64]))) -> Vec<f64> {
    let reference = &reference()["problems"][problem];
    let theta: Vec<f64> = numbers(&reference["theta_0"]).collect();
    assert_eq!(theta.len(), 3);
    let mut errors = Vec::new();
    run(&theta, &mut |time, state| {
        let expected = &reference["t"][time.to_string()];
        let expected: Vec<f64> = numbers(&expected["theta"])
            .chain(numbers(&expected["omega"]))
            .collect();
        assert_eq!((expected.len(), state.len()), (6, 6));
        let differences = expected.iter().zip(state).map(|(a, b)| (a - b).abs());
        errors.push(differences.fold(0.0, f64::max));
    });
    errors
}

type Angles<'a> = AbsoluteAngles<&'a BranchedDouble>;

fn in_absolute_angles<'a>(
    ode: &Angles<'a>,
    method: &impl Integrator<f64, Angles<'a>>,
    problem: &str,
    times: &[f64],
) -> Vec<f64> {
    errors(problem, |theta, visit| {
        let start = State::at_rest(0.0, theta);
        method.sample(ode, &start, times, visit).unwrap();
    })
}

/// Errors of all adaptive methods at the tolerance 1e-13, with their names. Sums
/// are compensated: near the threshold the rounding of 20,000 short steps grows
/// 3e7 times.
fn by_every_method(problem: &str, times: &[f64]) -> [(&'static str, Vec<f64>); 3] {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let options = || Options {
        compensated: true,
        ..Options::with_tolerance(1e-13)
    };
    [
        (
            "Dopri5",
            in_absolute_angles(&ode, &Dopri5::new(options()), problem, times),
        ),
        (
            "Dop853",
            in_absolute_angles(&ode, &Dop853::new(options()), problem, times),
        ),
        (
            "Verner98",
            in_absolute_angles(&ode, &Verner98::new(options()), problem, times),
        ),
    ]
}

fn in_symmetric_coordinates(problem: &str, times: &[f64]) -> Vec<f64> {
    errors(problem, |theta, visit| {
        let start = [
            theta[0],
            0.5 * (theta[1] + theta[2]),
            0.5 * (theta[1] - theta[2]),
        ];
        Dop853::new(Options::with_tolerance(1e-13))
            .sample(
                &SymmetricCoordinates(&BranchedDouble::paper()),
                &State::at_rest(0.0, &start),
                times,
                |time, state| {
                    if let &[q1, qm, qd, v1, vm, vd] = state {
                        visit(time, &[q1, qm + qd, qm - qd, v1, vm + vd, vm - vd]);
                    }
                },
            )
            .unwrap();
    })
}

#[test]
fn regular_motion() {
    let times = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    let symmetric = ("symmetric", in_symmetric_coordinates("regular", &times));
    for (name, errors) in by_every_method("regular", &times)
        .into_iter()
        .chain([symmetric])
    {
        assert_eq!(errors.len(), 7);
        // The error of order 5 is some ten times that of the higher ones at
        // equal tolerance.
        let limit = if name == "Dopri5" { 1e-11 } else { 1e-12 };
        assert!(errors[3] < limit, "{name} {errors:?}");
    }
}

#[test]
fn motion_near_the_threshold() {
    let times = [1.0, 2.0, 5.0, 10.0];
    let symmetric = (
        "symmetric",
        in_symmetric_coordinates("near-threshold", &times),
    );
    for (name, errors) in by_every_method("near-threshold", &times)
        .into_iter()
        .chain([symmetric])
    {
        assert_eq!(errors.len(), 4);
        println!("near the threshold, {name}: {errors:?}");
        assert!(errors[3] < 1e-7, "{name} {errors:?}");
    }
}

#[test]
fn the_in_phase_motion_has_no_difference() {
    let mut visits = 0;
    Dop853::new(Options::with_tolerance(1e-10))
        .integrate(
            &SymmetricCoordinates(&BranchedDouble::paper()),
            &State::at_rest(0.0, &[0.8, 0.1, 0.0]),
            100.0,
            |step| {
                visits += 1;
                assert_eq!((step.end()[2], step.end()[5]), (0.0, 0.0));
                core::ops::ControlFlow::Continue(())
            },
        )
        .unwrap();
    assert!(visits > 1000);
}
