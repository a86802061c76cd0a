//! Limits of methods, into which each is driven: what must come out is an error
//! with the state to continue from, or a bounded, stated degradation.
//!
//! Elsewhere: steps that no solver solves (`gauss.rs`), events at the start and
//! two in a step (`events.rs`), spans of zero and impossible requests
//! (`requests.rs`), time running backwards (`accuracy.rs`), the horizon of
//! chaos (`variational.rs`).

use branched_pendulum::integrate::{Solver, Tolerance};
use branched_pendulum::prelude::*;

use crate::problems::{BranchedDouble, Problem, harmonic, watch};

/// y' = −λ y with y(0) = 1: friction, stiff for large λ.
fn friction(rate: f64) -> impl Ode<f64> {
    Problem::new(1, move |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = -rate * y[0]
    })
}

fn one() -> State<f64> {
    State::new(0.0, vec![1.0])
}

/// Largest relative error of the energy along a motion in absolute angles.
fn energy_error(
    pendulum: &BranchedDouble,
    method: &impl for<'a> Integrator<f64, AbsoluteAngles<&'a BranchedDouble>>,
    start: &State<f64>,
    end: f64,
) -> Result<f64, IntegrationError<f64>> {
    let energy = |state: &[f64]| {
        let (theta, omega) = state.split_at(3);
        pendulum.kinetic_energy_of(theta, omega) + pendulum.potential_energy_of(theta)
    };
    let initial = energy(&start.values);
    let mut worst = 0.0_f64;
    method.integrate(&AbsoluteAngles(pendulum), start, end, |step| {
        worst = worst.max((energy(step.end()) / initial - 1.0).abs());
        ControlFlow::Continue(())
    })?;
    Ok(worst)
}

#[test]
fn steps_too_long_for_rk4_end_in_an_error_with_the_last_state() {
    // Stable up to h λ = 2.785 (Solving ODEs II, section IV.2).
    let end = |step: f64| Rk4::new(step).integrate(&friction(1000.0), &one(), 100.0, watch);
    let stable = end(0.00278).unwrap();
    assert!(stable.state.values[0].abs() < 1e-9);
    for step in [0.0028, 0.01] {
        let error = end(step).unwrap_err();
        let IntegrationError::NonFinite {
            time, last, report, ..
        } = &error
        else {
            panic!("{error:?}");
        };
        assert!(*time > last.time && last.values[0].is_finite());
        assert_eq!(report.stop, StopReason::NonFinite);
    }
}

#[test]
fn long_steps_of_rk4_on_the_pendulum_lose_the_energy() {
    let pendulum = BranchedDouble::paper();
    let start = State::at_rest(0.0, &[1.5, 1e-3, -1e-3]);
    let error = |step| energy_error(&pendulum, &Rk4::new(step), &start, 60.0);
    assert!(error(0.001).unwrap() < 1e-3);
    assert!(
        !matches!(error(0.05), Ok(worst) if worst < 0.1),
        "nothing failed"
    );
}

#[test]
fn stiff_friction_costs_explicit_methods_steps_and_not_accuracy() {
    let rate = 1e6;
    for limit in [100, 1_000_000] {
        let options = Options {
            step_limit: limit,
            ..Options::with_tolerance(1e-6)
        };
        let outcome = Dopri5::new(options).integrate(&friction(rate), &one(), 1.0, watch);
        if limit == 100 {
            let error = outcome.unwrap_err();
            assert!(matches!(
                error,
                IntegrationError::StepLimit { limit: 100, .. }
            ));
            assert!(error.last_state().unwrap().values[0].abs() <= 1.0);
        } else {
            let solution = outcome.unwrap();
            assert!(solution.state.values[0].abs() < 1e-6);
            // As many steps as stability asks for, whatever the tolerance.
            assert!(solution.report.accepted > 100_000, "{}", solution.report);
        }
    }
    let newton = Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Four, 0.1)
    };
    let solution = newton
        .integrate(&friction(rate), &one(), 1.0, watch)
        .unwrap();
    assert!(solution.state.values[0].abs() <= 1.0);
}

#[test]
fn children_that_spin_fast() {
    let pendulum = BranchedDouble::paper();
    let start = State::new(0.0, vec![0.5, 0.0, 0.1, 0.0, 60.0, -60.0]);
    let options = || Options::with_tolerance(1e-12);
    for error in [
        energy_error(&pendulum, &Dop853::new(options()), &start, 10.0),
        energy_error(&pendulum, &Verner98::new(options()), &start, 10.0),
        energy_error(&pendulum, &Dopri5::new(options()), &start, 10.0),
    ] {
        assert!(error.unwrap() < 1e-8);
    }
}

#[test]
fn angles_of_a_million_turns_lose_the_digits_that_they_hold() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let end = |turns: f64| {
        let by = turns * core::f64::consts::TAU;
        let start = State::at_rest(0.0, &[0.3 + by, 1e-3 + by, -1e-3 + by]);
        let solution = method.integrate(&ode, &start, 5.0, watch).unwrap();
        solution.state.values
    };
    let (near, far) = (end(0.0), end(159_155.0));
    // 1e6 rad hold the angle to 1e-10, and a relative tolerance is one of 1e6.
    for (a, b) in near[3..].iter().zip(&far[3..]) {
        assert!((a - b).abs() < 1e-4, "{a} {b}");
    }
    // An absolute tolerance gives what the digits allow.
    let absolute = Dop853::new(Options {
        relative: Tolerance::Uniform(0.0),
        absolute: Tolerance::Uniform(1e-10),
        ..Options::with_tolerance(1e-10)
    });
    let by = 159_155.0 * core::f64::consts::TAU;
    let start = State::at_rest(0.0, &[0.3 + by, 1e-3 + by, -1e-3 + by]);
    let far = absolute
        .integrate(&ode, &start, 5.0, watch)
        .unwrap()
        .state
        .values;
    for (a, b) in near[3..].iter().zip(&far[3..]) {
        assert!((a - b).abs() < 1e-7, "{a} {b}");
    }
}

#[test]
fn equilibria_hanging_and_upright() {
    let pendulum = BranchedDouble::paper();
    let ode = AbsoluteAngles(&pendulum);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let hanging = State::at_rest(0.0, &[0.0; 3]);
    let end = method.integrate(&ode, &hanging, 100.0, watch).unwrap();
    assert_eq!(end.state.values, hanging.values);
    // π is not a number of the type: sin(π) = 1.2e-16 starts the fall, which
    // takes as long as that takes to grow.
    let pi = core::f64::consts::PI;
    let upright = State::at_rest(0.0, &[pi; 3]);
    let soon = method.integrate(&ode, &upright, 1.0, watch).unwrap();
    assert!(
        soon.state
            .positions()
            .iter()
            .all(|angle| (angle - pi).abs() < 1e-9)
    );
    let error = energy_error(&pendulum, &method, &upright, 20.0).unwrap();
    assert!(error < 1e-9, "{error}");
    let late = method.integrate(&ode, &upright, 20.0, watch).unwrap();
    assert!(late.state.velocities().iter().any(|rate| rate.abs() > 1.0));
}

#[test]
fn every_method_stays_on_the_in_phase_manifold() {
    fn stays<'a>(
        method: &impl Integrator<f64, SymmetricCoordinates<&'a BranchedDouble>>,
        pendulum: &'a BranchedDouble,
    ) {
        let start = State::at_rest(0.0, &[0.9, 0.1, 0.0]);
        let observer = |step: &mut DenseStep<'_, f64>| {
            assert_eq!((step.end()[2], step.end()[5]), (0.0, 0.0));
            ControlFlow::Continue(())
        };
        method
            .integrate(&SymmetricCoordinates(pendulum), &start, 20.0, observer)
            .unwrap();
    }
    let pendulum = BranchedDouble::paper();
    let options = || Options::with_tolerance(1e-9);
    stays(&Dopri5::new(options()), &pendulum);
    stays(&Verner98::new(options()), &pendulum);
    stays(&Rk4::new(0.005), &pendulum);
    stays(&Gauss::new(GaussOrder::Eight, 0.02), &pendulum);
    stays(&Gauss::for_animation(1.0 / 60.0), &pendulum);
}

/// The paper's pendulum with children whose masses are so many times smaller.
fn light(ratio: f64) -> BranchedDouble {
    let paper = BranchedDouble::paper();
    BranchedDouble {
        m2: paper.m2 * ratio,
        mu: paper.mu * ratio,
        g2: paper.g2 * ratio,
        ..paper
    }
}

#[test]
fn children_lighter_by_twelve_orders_do_not_disturb_their_parent() {
    let start = State::at_rest(0.0, &[1.0, 0.2, -0.1]);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let light = light(1e-12);
    let alone = Problem::new(2, move |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = -light.g1 / light.m1 * y[0].sin();
    });
    let parent = method
        .integrate(&alone, &State::at_rest(0.0, &[1.0]), 10.0, watch)
        .unwrap();
    let whole = method
        .integrate(&AbsoluteAngles(&light), &start, 10.0, watch)
        .unwrap();
    assert!((whole.state.values[0] - parent.state.values[0]).abs() < 1e-9);
    assert!(whole.state.values.iter().all(|value| value.is_finite()));
}

#[test]
fn children_heavier_by_nine_orders_keep_the_energy() {
    // A parent of nothing with children of something: M is as near to singular
    // as 1e-9.
    let paper = BranchedDouble::paper();
    let mut heavy = light(1.0);
    heavy.m1 = 2.0 * paper.mu * paper.mu / paper.m2 * (1.0 + 1e-9);
    let start = State::at_rest(0.0, &[0.3, 0.4, 0.35]);
    let options = Options {
        step_limit: 100_000,
        ..Options::with_tolerance(1e-10)
    };
    let worst = energy_error(&heavy, &Dop853::new(options), &start, 0.5).unwrap();
    assert!(worst < 1e-4, "{worst}");
}

#[test]
fn a_disturbance_of_1e_300_grows_as_any_other() {
    let pendulum = BranchedDouble::paper();
    let ode = SymmetricCoordinates(&pendulum);
    let method = Dop853::new(Options::with_tolerance(1e-11));
    let growth = |disturbance: f64| {
        let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 0.0, disturbance]);
        let solution = method.integrate(&ode, &start, 8.0, watch).unwrap();
        solution.state.values[2] / disturbance
    };
    let (tiny, small) = (growth(1e-300), growth(1e-30));
    assert!(tiny.abs() > 1e2, "{tiny}");
    assert!((tiny / small - 1.0).abs() < 1e-9, "{tiny} {small}");
}

#[test]
fn a_tolerance_near_rounding_ends_with_an_error_or_with_rounding() {
    let options = Options {
        step_limit: 20_000,
        ..Options::with_tolerance(0.25 * f64::EPSILON)
    };
    fn outcome(result: Result<Solution<f64>, IntegrationError<f64>>) {
        match result {
            Ok(solution) => {
                let error = (solution.state.values[0] - 1.0_f64.cos()).abs();
                assert!(error < 1e-12, "{error}");
            }
            Err(error) => {
                let last = error.last_state().unwrap();
                assert!((last.values[0] - last.time.cos()).abs() < 1e-12, "{error}");
            }
        }
    }
    let start = State::at_rest(0.0, &[1.0]);
    let ode = harmonic();
    outcome(Dop853::new(options.clone()).integrate(&ode, &start, 1.0, watch));
    outcome(Dopri5::new(options.clone()).integrate(&ode, &start, 1.0, watch));
    outcome(Verner98::new(options).integrate(&ode, &start, 1.0, watch));
}
