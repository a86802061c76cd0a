//! The measured order must be the stated one.

use core::f64::consts::TAU;

use branched_pendulum::prelude::*;

use crate::problems::{driven_oscillator, driven_oscillator_at, kepler, perihelion, watch};

/// Slope of the straight line through (ln step, ln error), by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logarithms = points.iter().map(|(step, error)| (step.ln(), error.ln()));
    let (x, y) = logarithms
        .clone()
        .fold((0.0, 0.0), |(x, y), (a, b)| (x + a / n, y + b / n));
    let (xx, xy) = logarithms.fold((0.0, 0.0), |(xx, xy), (a, b)| {
        (xx + (a - x) * (a - x), xy + (a - x) * (b - y))
    });
    xy / xx
}

/// Largest error at `end` after so many equal steps.
fn global_error(
    ode: &impl Ode<f64>,
    start: &State<f64>,
    end: f64,
    exact: &[f64],
    count: u32,
) -> f64 {
    let method = Dop853::new(Options::with_tolerance(1.0));
    let mut state = start.clone();
    for _ in 0..count {
        state = method
            .step(ode, &state, (end - start.time) / f64::from(count))
            .unwrap();
    }
    largest_difference(&state.values, exact)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |largest, (a, b)| largest.max((a - b).abs()))
}

fn assert_order(points: &[(f64, f64)], power: f64, tolerance: f64) {
    assert!(
        points.iter().all(|&(_, error)| error > 1e-14),
        "rounding: {points:?}"
    );
    let found = slope(points);
    assert!(
        (found - power).abs() < tolerance,
        "power {found} from {points:?}"
    );
}

#[test]
fn global_error_falls_with_the_eighth_power_of_the_step() {
    let circle = perihelion(0.0);
    let points = [24_u32, 32, 40, 48].map(|n| {
        (
            TAU / f64::from(n),
            global_error(&kepler(), &circle, TAU, &circle.values, n),
        )
    });
    assert_order(&points, 8.0, 0.2);
}

#[test]
fn time_dependent_rates_do_not_lower_the_order() {
    let start = State::new(0.0, driven_oscillator_at(0.0).to_vec());
    let points = [24_u32, 32, 40, 48].map(|n| {
        let error = global_error(
            &driven_oscillator(),
            &start,
            5.0,
            &driven_oscillator_at(5.0),
            n,
        );
        (5.0 / f64::from(n), error)
    });
    assert_order(&points, 8.0, 0.2);
}

/// Errors of one step on the circular orbit: at its end, and the largest
/// inside.
fn local_errors(step: f64) -> (f64, f64) {
    let options = Options {
        initial_step: Some(step),
        ..Options::with_tolerance(1.0)
    };
    let exact = |time: f64| [time.cos(), time.sin(), -time.sin(), time.cos()];
    let (mut end, mut inside) = (0.0, 0.0_f64);
    let solution = Dop853::new(options)
        .integrate(&kepler(), &perihelion(0.0), step, |dense| {
            end = largest_difference(dense.end(), &exact(step));
            for i in 1..20 {
                let time = step * f64::from(i) / 20.0;
                let mut value = [0.0; 4];
                dense.eval(time, &mut value).unwrap();
                inside = inside.max(largest_difference(&value, &exact(time)));
            }
            watch(dense)
        })
        .unwrap();
    assert_eq!(solution.report.accepted, 1);
    (end, inside)
}

#[test]
fn one_step_has_an_error_of_its_ninth_power() {
    let points = [0.6, 0.5, 0.4, 0.3, 0.2].map(|step| (step, local_errors(step).0));
    assert_order(&points, 8.0 + 1.0, 0.2);
}

#[test]
fn dense_output_of_order_seven_has_an_error_of_the_eighth_power() {
    let points = [0.5, 0.4, 0.3, 0.2, 0.15].map(|step| (step, local_errors(step).1));
    assert_order(&points, 7.0 + 1.0, 0.2);
}
