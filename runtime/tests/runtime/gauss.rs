//! The Gauss–Legendre methods: energy over long times, symmetry, solvers, and
//! what happens where a step has no solution.

use branched_pendulum::integrate::Solver;
use branched_pendulum::prelude::*;

use crate::problems::{BranchedDouble, Problem, watch};

/// The reference's regular case, in canonical variables.
fn regular() -> State<f64> {
    State::at_rest(0.0, &[0.3, 1e-3, -1e-3])
}

#[test]
fn canonical_and_lagrangian_equations_agree() {
    let pendulum = BranchedDouble::paper();
    let end = |method: &dyn Fn() -> State<f64>| method();
    let canonical = end(&|| {
        let ode = CanonicalVariables(&pendulum);
        let method = Dop853::new(Options::with_tolerance(1e-13));
        method
            .integrate(&ode, &regular(), 3.0, watch)
            .unwrap()
            .state
    });
    let lagrangian = end(&|| {
        let ode = AbsoluteAngles(&pendulum);
        let method = Dop853::new(Options::with_tolerance(1e-13));
        method
            .integrate(&ode, &regular(), 3.0, watch)
            .unwrap()
            .state
    });
    let both = canonical.positions().iter().zip(lagrangian.positions());
    for (a, b) in both {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

/// Relative energy errors at the ends of `parts` equal parts of a run.
fn energy_errors(method: &Gauss<f64>, duration: f64, parts: u32) -> Vec<f64> {
    let pendulum = BranchedDouble::paper();
    let initial = pendulum.hamiltonian(&regular().values);
    let mut errors = Vec::new();
    let times: Vec<f64> = (1..=parts)
        .map(|part| duration * f64::from(part) / f64::from(parts))
        .collect();
    let mut pending = times.into_iter().peekable();
    method
        .integrate(
            &CanonicalVariables(&pendulum),
            &regular(),
            duration,
            |step| {
                if pending.next_if(|&time| time <= step.end_time()).is_some() {
                    errors.push(pendulum.hamiltonian(step.end()) / initial - 1.0);
                }
                ControlFlow::Continue(())
            },
        )
        .unwrap();
    errors
}

#[test]
fn energy_does_not_drift_over_a_thousand_seconds() {
    let errors = energy_errors(&Gauss::new(GaussOrder::Eight, 0.005), 1000.0, 100);
    assert_eq!(errors.len(), 100);
    let worst = errors.iter().fold(0.0_f64, |worst, e| worst.max(e.abs()));
    assert!(worst < 1e-14, "{worst:e}");
    // No trend: the straight line through all errors rises by less than their
    // spread.
    let middle = 0.5 * (errors.len() as f64 - 1.0);
    let (slope, squares) = errors.iter().enumerate().fold((0.0, 0.0), |sums, (i, e)| {
        let x = i as f64 - middle;
        (sums.0 + x * e, sums.1 + x * x)
    });
    let rise = (slope / squares * errors.len() as f64).abs();
    assert!(rise < 5e-15, "{rise:e}");
}

/// Long steps: the error of the energy is large, and stays what it is.
#[test]
fn energy_error_of_long_steps_is_bounded() {
    let errors = energy_errors(&Gauss::new(GaussOrder::Four, 0.05), 1000.0, 1000);
    let worst = |part: &[f64]| part.iter().fold(0.0_f64, |worst, e| worst.max(e.abs()));
    let (early, late) = (worst(&errors[..100]), worst(&errors[900..]));
    assert!(early > 1e-6, "a case without error shows nothing: {early}");
    assert!(late < 1.5 * early, "{early} {late}");
}

#[test]
fn a_symmetric_method_returns_to_its_start() {
    let pendulum = BranchedDouble::paper();
    let ode = CanonicalVariables(&pendulum);
    for order in [GaussOrder::Two, GaussOrder::Six] {
        let method = Gauss::new(order, 0.02);
        let there = method.integrate(&ode, &regular(), 2.0, watch).unwrap();
        let back = method.integrate(&ode, &there.state, 0.0, watch).unwrap();
        for (a, b) in back.state.values.iter().zip(&regular().values) {
            assert!((a - b).abs() < 1e-13, "{order:?}: {a} {b}");
        }
    }
}

#[test]
fn both_solvers_reach_the_same_step() {
    let pendulum = BranchedDouble::paper();
    let ode = CanonicalVariables(&pendulum);
    let run = |solver| {
        let method = Gauss {
            solver,
            ..Gauss::new(GaussOrder::Eight, 0.02)
        };
        method
            .integrate(&ode, &regular(), 1.0, watch)
            .unwrap()
            .state
    };
    let (a, b) = (run(Solver::FixedPoint), run(Solver::Newton));
    for (a, b) in a.values.iter().zip(&b.values) {
        assert!((a - b).abs() < 1e-13, "{a} {b}");
    }
}

/// y' = −λ y, far too stiff for a fixed point: h λ = 1000.
fn stiff() -> impl Ode<f64> {
    Problem::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = -1e4 * y[0]
    })
}

#[test]
fn newton_solves_what_a_fixed_point_cannot() {
    let one = State::new(0.0, vec![1.0]);
    let newton = Gauss {
        solver: Solver::Newton,
        ..Gauss::new(GaussOrder::Four, 0.1)
    };
    let solution = newton.integrate(&stiff(), &one, 1.0, watch).unwrap();
    assert_eq!(
        (solution.report.accepted, solution.report.rejected),
        (10, 0)
    );
    // Stable, not damping: the methods keep what they should kill.
    assert!(solution.state.values[0].abs() < 1.0);

    let fixed = Gauss {
        halvings: 3,
        ..Gauss::new(GaussOrder::Four, 0.1)
    };
    let error = fixed.integrate(&stiff(), &one, 1.0, watch).unwrap_err();
    let IntegrationError::NotSolved {
        step, last, report, ..
    } = &error
    else {
        panic!("{error:?}");
    };
    assert_eq!((*step, last, report.rejected), (0.1 / 8.0, &one, 3));
    assert_eq!(report.stop, StopReason::NotSolved);
    assert!(
        error
            .to_string()
            .starts_with("a step of 0.0125 at t = 0 is not solved after ")
    );
    assert_eq!(error.last_state(), Some(&one));
}

#[test]
fn halved_steps_return_to_the_grid() {
    // Stiff only around t = 0.55.
    let ode = Problem::new(1, |time: f64, y: &[f64], rates: &mut [f64]| {
        let stiffness = if (time - 0.55).abs() < 0.035 {
            60.0
        } else {
            1.0
        };
        rates[0] = -stiffness * y[0];
    });
    let mut ends = Vec::new();
    let solution = Gauss::new(GaussOrder::Four, 0.1)
        .integrate(&ode, &State::new(0.0, vec![1.0]), 1.0, |step| {
            ends.push(step.end_time());
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(solution.report.rejected > 0, "{}", solution.report);
    for k in 1..=10 {
        let time = if k == 10 { 1.0 } else { f64::from(k) * 0.1 };
        assert!(ends.contains(&time), "{time}: {ends:?}");
    }
    assert!(ends.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn rates_that_end_are_reported_with_the_last_state() {
    // y' = √(1 − t) is NaN beyond t = 1.
    let ode = Problem::new(1, |time: f64, _y: &[f64], rates: &mut [f64]| {
        rates[0] = (1.0 - time).sqrt();
    });
    let zero = State::new(0.0, vec![0.0]);
    let plain = Rk4::new(0.3).integrate(&ode, &zero, 2.0, watch);
    let halved = Gauss::new(GaussOrder::Six, 0.3).integrate(&ode, &zero, 2.0, watch);
    for (outcome, nearness) in [(plain, 0.3), (halved, 0.3 / 1024.0)] {
        let error = outcome.unwrap_err();
        let IntegrationError::NonFinite { time, last, .. } = &error else {
            panic!("{error:?}");
        };
        assert!(*time > 1.0 && last.time <= 1.0 && 1.0 - last.time <= nearness);
        assert!((last.values[0] - 2.0 / 3.0).abs() < 0.1);
    }
    // Undefined at the start: at once.
    let late = State::new(1.5, vec![0.0]);
    let error = Gauss::new(GaussOrder::Two, 0.1).integrate(&ode, &late, 2.0, watch);
    assert_eq!(error.unwrap_err().report().unwrap().evaluations, 1);
}
