//! Tolerances are kept, forwards, backwards, in f64 and f32.

use core::f64::consts::TAU;

use branched_pendulum::integrate::Tolerance;
use branched_pendulum::prelude::*;

use crate::problems::{
    BranchedDouble, Problem, growth_and_decay, growth_and_decay_at, harmonic, kepler, perihelion,
    watch,
};

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |largest, (a, b)| largest.max((a - b).abs()))
}

#[test]
fn harmonic_oscillator_over_a_hundred_turns() {
    let start = State::at_rest(0.0, &[1.0]);
    let end = 100.0 * TAU;
    let solution = Dop853::new(Options::with_tolerance(1e-13))
        .integrate(&harmonic(), &start, end, watch)
        .unwrap();
    assert_eq!(solution.report.stop, StopReason::EndReached);
    assert_eq!(solution.state.time, end);
    assert!(largest_difference(&solution.state.values, &[end.cos(), -end.sin()]) < 2e-11);
}

#[test]
fn kepler_returns_after_one_turn_and_error_follows_the_tolerance() {
    let start = perihelion(0.6);
    let mut previous = f64::INFINITY;
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let solution = Dop853::new(Options::with_tolerance(tolerance))
            .integrate(&kepler(), &start, TAU, watch)
            .unwrap();
        let error = largest_difference(&solution.state.values, &start.values);
        assert!(error < 200.0 * tolerance, "{tolerance}: {error}");
        assert!(
            error < 0.1 * previous,
            "{tolerance}: {error} after {previous}"
        );
        previous = error;
    }
}

#[test]
fn backwards_undoes_forwards() {
    let method = Dop853::new(Options::with_tolerance(1e-13));
    let start = perihelion(0.3);
    let there = method.integrate(&kepler(), &start, 5.0, watch).unwrap();
    let back = method
        .integrate(&kepler(), &there.state, 0.0, watch)
        .unwrap();
    assert_eq!(back.state.time, 0.0);
    assert!(largest_difference(&back.state.values, &start.values) < 1e-11);
    // The time runs backwards in the right-hand side too.
    let start = State::new(3.0, vec![growth_and_decay_at(3.0)]);
    let solution = method
        .integrate(&growth_and_decay(), &start, -2.0, watch)
        .unwrap();
    assert!((solution.state.values[0] - growth_and_decay_at(-2.0)).abs() < 1e-11);
}

#[test]
fn f32_reaches_what_its_rounding_allows() {
    let start: State<f32> = perihelion(0.3);
    let solution = Dop853::new(Options::with_tolerance(1e-6_f32))
        .integrate(&kepler(), &start, core::f32::consts::TAU, watch)
        .unwrap();
    for (end, start) in solution.state.values.iter().zip(&start.values) {
        assert!((end - start).abs() < 2e-5, "{:?}", solution.state);
    }
    let mut samples = 0;
    Dop853::new(Options::with_tolerance(1e-6_f32))
        .sample(
            &harmonic(),
            &State::at_rest(0.0, &[1.0_f32]),
            &[0.5, 1.0, 4.0],
            |time, y| {
                samples += 1;
                assert!((y[0] - time.cos()).abs() < 1e-5);
            },
        )
        .unwrap();
    assert_eq!(samples, 3);
}

#[test]
fn tolerances_per_component_govern_their_component() {
    // Two uncoupled oscillators; only the tolerance of the fast one can make
    // steps short.
    let ode = Problem::new(4, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates.copy_from_slice(&[y[2], y[3], -y[0], -2500.0 * y[1]]);
    });
    let start = State::at_rest(0.0, &[1.0, 1.0]);
    let steps = |fast: f64| {
        let options = Options {
            relative: Tolerance::Uniform(0.0),
            absolute: Tolerance::PerComponent(vec![1e-9, fast, 1e-9, 50.0 * fast]),
            ..Options::with_tolerance(1.0)
        };
        Dop853::new(options)
            .integrate(&ode, &start, 1.0, watch)
            .unwrap()
            .report
            .accepted
    };
    assert!(steps(1e-9) > 2 * steps(1e-3));
}

#[test]
fn dense_output_is_continuous_and_as_accurate_as_the_steps() {
    let mut count = 0;
    Dop853::new(Options::with_tolerance(1e-10))
        .integrate(&harmonic(), &State::at_rest(0.0, &[1.0]), 20.0, |step| {
            let mut value = [0.0; 2];
            step.eval(step.start_time(), &mut value).unwrap();
            assert_eq!(value, step.start());
            step.eval(step.end_time(), &mut value).unwrap();
            assert_eq!(value, step.end());
            for i in 1..10 {
                let fraction = f64::from(i) / 10.0;
                let time = step.start_time() + fraction * (step.end_time() - step.start_time());
                step.eval(time, &mut value).unwrap();
                assert!(largest_difference(&value, &[time.cos(), -time.sin()]) < 2e-9);
                count += 1;
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(count > 100);
}

#[test]
fn sampling_does_not_change_the_steps() {
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let start = perihelion(0.5);
    let plain = method.integrate(&kepler(), &start, 10.0, watch).unwrap();
    let times: Vec<f64> = (0..=1000).map(|i| 0.01 * f64::from(i)).collect();
    let mut visited = Vec::new();
    let sampled = method
        .sample(&kepler(), &start, &times, |time, _| visited.push(time))
        .unwrap();
    assert_eq!(visited, times);
    assert_eq!(sampled.state, plain.state);
    assert_eq!(sampled.report.accepted, plain.report.accepted);
    // Three evaluations for each step that was looked into, no more.
    let extra = sampled.report.evaluations - plain.report.evaluations;
    assert!(extra > 0 && extra <= 3 * plain.report.accepted);
}

#[test]
fn samples_backwards_at_the_start_and_repeated() {
    let mut visited = Vec::new();
    let solution = Dop853::new(Options::with_tolerance(1e-11))
        .sample(
            &growth_and_decay(),
            &State::new(0.0, vec![1.0]),
            &[0.0, 0.0, -0.5, -0.5, -3.0],
            |time, y| visited.push((time, y[0])),
        )
        .unwrap();
    assert_eq!(visited.len(), 5);
    for (time, y) in &visited {
        assert!((y - growth_and_decay_at(*time)).abs() < 1e-9);
    }
    assert_eq!(visited[2], visited[3]);
    assert_eq!(solution.state.time, -3.0);
}

#[test]
fn a_component_that_is_zero_stays_zero_under_a_relative_tolerance() {
    let options = Options {
        absolute: Tolerance::Uniform(0.0),
        ..Options::with_tolerance(1e-10)
    };
    let ode = Problem::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = -y[0];
        rates[1] = -y[1];
    });
    let solution = Dop853::new(options)
        .integrate(&ode, &State::new(0.0, vec![1.0, 0.0]), 3.0, watch)
        .unwrap();
    assert_eq!(solution.state.values[1], 0.0);
    assert!((solution.state.values[0] - (-3.0_f64).exp()).abs() < 1e-10);
}

#[test]
fn energy_of_the_paper_s_pendulum_is_held_to_1e_12() {
    let pendulum = BranchedDouble::paper();
    let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 1e-3, -1e-3]);
    let energy = |values: &[f64]| {
        let (theta, omega) = values.split_at(3);
        pendulum.kinetic_energy_of(theta, omega) + pendulum.potential_energy_of(theta)
    };
    for compensated in [false, true] {
        let options = Options {
            compensated,
            ..Options::with_tolerance(1e-14)
        };
        let before = energy(&start.values);
        let mut largest = 0.0_f64;
        Dop853::new(options)
            .integrate(&AbsoluteAngles(&pendulum), &start, 10.0, |step| {
                largest = largest.max((energy(step.end()) / before - 1.0).abs());
                ControlFlow::Continue(())
            })
            .unwrap();
        assert!(largest < 1e-12, "compensated {compensated}: {largest}");
    }
}

#[test]
fn compensated_sums_lose_less() {
    // A large value that moves little: a thousand steps, each with a rounding
    // error of the sum a thousand times that of the increment.
    let ode = Problem::new(1, |time: f64, _y: &[f64], rates: &mut [f64]| {
        rates[0] = time.cos()
    });
    let error = |compensated| {
        let options = Options {
            max_step: Some(0.01),
            compensated,
            ..Options::with_tolerance(1e-12)
        };
        let solution = Dop853::new(options)
            .integrate(&ode, &State::new(0.0, vec![1000.0]), 10.0, watch)
            .unwrap();
        assert!(solution.report.accepted >= 990);
        (solution.state.values[0] - (1000.0 + 10.0_f64.sin())).abs()
    };
    let ulp = 1000.0_f64.next_up() - 1000.0;
    assert!(error(true) <= ulp, "{}", error(true));
    assert!(error(false) > 3.0 * ulp, "{}", error(false));
}
