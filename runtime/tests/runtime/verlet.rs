//! Störmer–Verlet: its order and energy where H = T(p) + U(q), and the refusal
//! everywhere else.

use branched_pendulum::integrate::{InputError, Inseparable, StoermerVerlet};
use branched_pendulum::prelude::*;

use crate::problems::{BranchedDouble, watch};

/// Two pendulums of different length, with a friction that may be zero.
struct Pair {
    friction: f64,
}

impl Canonical<f64> for Pair {
    fn degrees_of_freedom(&self) -> usize {
        2
    }

    fn canonical_rates(&self, _: f64, q: &[f64], p: &[f64], v: &mut [f64], f: &mut [f64]) {
        for (k, stiffness) in [1.0, 2.5].into_iter().enumerate() {
            v[k] = p[k];
            f[k] = -stiffness * q[k].sin() - self.friction * p[k];
        }
    }
}

fn energy(y: &[f64]) -> f64 {
    0.5 * (y[2] * y[2] + y[3] * y[3]) - y[0].cos() - 2.5 * y[1].cos()
}

#[test]
fn order_two_and_an_energy_that_does_not_drift() {
    let pair = Pair { friction: 0.0 };
    let ode = CanonicalVariables(&pair);
    let start = State::from_positions_and_momenta(0.0, &[2.0, -1.0], &[0.0, 0.3]).unwrap();
    let exact = Verner98::new(Options::with_tolerance(1e-13));
    let exact = exact
        .integrate(&ode, &start, 5.0, watch)
        .unwrap()
        .state
        .values;
    let error = |step: f64| {
        let method = StoermerVerlet::new(step);
        let end = method.integrate(&ode, &start, 5.0, watch).unwrap();
        let both = end.state.values.iter().zip(&exact);
        both.fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()))
    };
    let order = (error(0.02) / error(0.01)).log2();
    assert!((order - 2.0).abs() < 0.05, "{order}");

    // Largest error in the first and in the last tenth of 10,000 s.
    let (mut early, mut late, initial) = (0.0_f64, 0.0_f64, energy(&start.values));
    let observer = |step: &mut DenseStep<'_, f64>| {
        let error = (energy(step.end()) - initial).abs();
        if step.end_time() < 1e3 {
            early = early.max(error);
        } else if step.end_time() > 9e3 {
            late = late.max(error);
        }
        core::ops::ControlFlow::Continue(())
    };
    let method = StoermerVerlet::new(0.05);
    let report = method
        .integrate(&ode, &start, 1e4, observer)
        .unwrap()
        .report;
    assert_eq!(report.evaluations, 2 * report.accepted + 1);
    assert!(early < 5e-3 && late < 1.1 * early, "{early} {late}");
}

/// The method returns to the start when time runs back.
#[test]
fn it_is_symmetric() {
    let pair = Pair { friction: 0.0 };
    let ode = CanonicalVariables(&pair);
    let start = State::from_positions_and_momenta(0.0, &[2.0, -1.0], &[0.0, 0.3]).unwrap();
    let method = StoermerVerlet::new(0.125);
    let there = method.integrate(&ode, &start, 8.0, watch).unwrap().state;
    let back = method.integrate(&ode, &there, 0.0, watch).unwrap().state;
    for (a, b) in back.values.iter().zip(&start.values) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

fn refusal<C: Canonical<f64>>(system: &C, start: &State<f64>) -> (usize, Inseparable, String) {
    let ode = CanonicalVariables(system);
    let method = StoermerVerlet::new(0.01);
    let error = method.integrate(&ode, start, 1.0, watch).unwrap_err();
    let message = error.to_string();
    match error {
        IntegrationError::Input(InputError::NotSeparable {
            coordinate, rate, ..
        }) => (coordinate, rate, message),
        other => panic!("{other}"),
    }
}

#[test]
fn trees_and_friction_are_refused() {
    // At rest and hanging, where nothing moves whatever the equations are.
    for start in [[0.0; 3], [0.3, 1e-3, -1e-3]] {
        let start = State::at_rest(0.0, &start);
        let (coordinate, rate, message) = refusal(&BranchedDouble::paper(), &start);
        assert_eq!((coordinate, rate), (0, Inseparable::Velocity));
        assert!(message.contains("H is not T(p) + U(q)"), "{message}");
    }
    let start = State::at_rest(0.0, &[1.0, 0.5]);
    let (_, rate, message) = refusal(&Pair { friction: 0.1 }, &start);
    assert_eq!(rate, Inseparable::Force);
    assert!(message.contains("momenta"), "{message}");
}
