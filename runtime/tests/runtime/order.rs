//! The measured order must be the stated one.

use core::f64::consts::TAU;

use branched_pendulum::integrate::Solver;
use branched_pendulum::prelude::*;

use crate::problems::{
    bell, bell_at, driven_oscillator, driven_oscillator_at, kepler, perihelion, watch,
};

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

/// Largest errors at the end of [`bell`] from −1 to 2 in so many steps.
fn bell_errors(
    counts: [u32; 4],
    run: impl Fn(&State<f64>, f64, u32) -> State<f64>,
) -> [(f64, f64); 4] {
    let start = State::new(-1.0, bell_at(-1.0).to_vec());
    counts.map(|count| {
        let step = 3.0 / f64::from(count);
        let end = run(&start, step, count);
        assert!((end.time - 2.0).abs() < 1e-13);
        (step, largest_difference(&end.values, &bell_at(2.0)))
    })
}

/// The errors of a method of one step length.
fn fixed_errors<M: Integrator<f64, dyn Ode<f64>>>(
    counts: [u32; 4],
    method: impl Fn(f64) -> M,
) -> [(f64, f64); 4] {
    let ode: &dyn Ode<f64> = &bell();
    bell_errors(counts, |start, step, count| {
        let solution = method(step).integrate(ode, start, 2.0, watch).unwrap();
        assert_eq!(solution.report.accepted, u64::from(count));
        solution.state
    })
}

#[test]
fn dopri5_has_order_five() {
    let method = Dopri5::new(Options::with_tolerance(1.0));
    let points = bell_errors([96, 128, 192, 256], |start, step, count| {
        (0..count).fold(start.clone(), |state, _| {
            method.step(&bell(), &state, step).unwrap()
        })
    });
    assert_order(&points, 5.0, 0.2);
}

#[test]
fn verner_s_method_has_order_nine() {
    let start = State::new(0.0, driven_oscillator_at(0.0).to_vec());
    let method = Verner98::new(Options::with_tolerance(1.0));
    let points = [16_u32, 20, 24, 28].map(|count| {
        let step = 5.0 / f64::from(count);
        let end = (0..count).fold(start.clone(), |state, _| {
            method.step(&driven_oscillator(), &state, step).unwrap()
        });
        (
            step,
            largest_difference(&end.values, &driven_oscillator_at(5.0)),
        )
    });
    // Between two whole orders, and nearer to this one: what its table has,
    // condition by condition, is tested beside it.
    assert_order(&points, 9.0, 0.35);
}

#[test]
fn the_classical_method_has_order_four() {
    assert_order(&fixed_errors([96, 128, 192, 256], Rk4::new), 4.0, 0.1);
}

#[test]
fn gauss_methods_have_twice_as_many_orders_as_stages() {
    for (order, expected, counts) in [
        (GaussOrder::Two, 2.0, [64, 96, 128, 192]),
        (GaussOrder::Four, 4.0, [32, 48, 64, 96]),
        (GaussOrder::Six, 6.0, [24, 32, 48, 64]),
        (GaussOrder::Eight, 8.0, [16, 20, 24, 32]),
    ] {
        for solver in [Solver::FixedPoint, Solver::Newton] {
            let points = fixed_errors(counts, |step| Gauss {
                solver,
                ..Gauss::new(order, step)
            });
            assert_order(&points, expected, 0.25);
        }
    }
}

/// Power of the step with which the error inside a first step of [`bell`]
/// falls.
fn order_inside<M: Integrator<f64, dyn Ode<f64>>>(
    steps: [f64; 4],
    begin: f64,
    method: impl Fn(f64) -> M,
) -> f64 {
    let points = steps.map(|step| {
        let mut inside = 0.0_f64;
        let observer = |dense: &mut DenseStep<'_, f64>| {
            for i in 1..20 {
                let time = begin + step * f64::from(i) / 20.0;
                let mut value = [0.0; 2];
                dense.eval(time, &mut value).unwrap();
                inside = inside.max(largest_difference(&value, &bell_at(time)));
            }
            watch(dense)
        };
        let ode: &dyn Ode<f64> = &bell();
        let start = State::new(begin, bell_at(begin).to_vec());
        let solution = method(step).integrate(ode, &start, begin + step, observer);
        assert_eq!(solution.unwrap().report.accepted, 1);
        (step, inside)
    });
    assert!(
        points.iter().all(|&(_, error)| error > 1e-14),
        "rounding: {points:?}"
    );
    slope(&points)
}

#[test]
fn values_inside_a_step_have_the_stated_orders() {
    let loose = |step| Options {
        initial_step: Some(step),
        ..Options::with_tolerance(1.0)
    };
    let found = order_inside([0.4, 0.3, 0.2, 0.1], 0.3, |step| Dopri5::new(loose(step)));
    assert!((found - 5.0).abs() < 0.3, "{found}");
    let found = order_inside([0.35, 0.3, 0.25, 0.2], 0.3, |step| {
        Verner98::new(loose(step))
    });
    assert!((found - 9.0).abs() < 0.3, "{found}");
    let found = order_inside([0.1, 0.08, 0.06, 0.04], 1.0, Rk4::new);
    assert!((found - 4.0).abs() < 0.3, "{found}");
    for (order, expected) in [
        (GaussOrder::Two, 2.0),
        (GaussOrder::Four, 3.0),
        (GaussOrder::Six, 4.0),
        (GaussOrder::Eight, 5.0),
    ] {
        let found = order_inside([0.1, 0.08, 0.06, 0.04], 1.0, |step| Gauss::new(order, step));
        assert!((found - expected).abs() < 0.3, "{order:?}: {found}");
    }
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
