//! References of the studies of accuracy against cost.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_advice::WorkPrecision;
use branched_pendulum_studies::scenes::{BranchedDouble, Rods};
use branched_pendulum_studies::work_precision::reference::{RODS, TOLERANCE, end_of, papers};

#[test]
fn all_problems_are_there() {
    let problems = papers();
    for problem in &problems {
        assert_eq!(problem.start.len(), 3);
        assert_eq!(problem.expected.len(), 6, "{problem:?}");
        assert!(problem.end >= 10.0);
    }
    // By eye, from the file.
    assert_eq!(problems[0].expected[0], -0.13514683809607428);
    assert_eq!(problems[2].expected[5], -8.352998681130677);
}

/// Checks that the orders and steps for another tolerance give the same digits, and so does
/// another method to within its accuracy.
#[test]
fn the_reference_of_the_rods_does_not_depend_on_how_it_is_computed() {
    let end = |tolerance| end_of(&Rods::<Double>::default(), &RODS, 10.0, tolerance).unwrap();
    let (found, other) = (end(TOLERANCE), end(1e-28));
    let method = Verner98::new(Options::with_tolerance(1e-14));
    let (model, start) = (Rods::new(), State::at_rest(0.0, &RODS));
    let verner = method.run(&AbsoluteAngles(&model), &start, 10.0).unwrap();
    for ((found, other), verner) in found.iter().zip(&other).zip(&verner.state.values) {
        assert!((found - other).abs() <= f64::EPSILON * found.abs());
        assert!((found - verner).abs() < 1e-11, "{found} {verner}");
    }
}

/// The error decreases with the tolerance down to rounding.
#[test]
fn errors_fall_to_rounding() {
    let problem = papers().remove(0);
    let (model, start) = (BranchedDouble::new(), State::at_rest(0.0, &problem.start));
    let (ode, methods) = (AbsoluteAngles(&model), [Method::Taylor]);
    let (end, expected) = (problem.end, &problem.expected);
    let measured = WorkPrecision::measure(&ode, &start, end, expected, &methods, |_, _| {});
    let errors = measured.runs().iter().map(|run| run.error);
    let errors: Vec<f64> = errors.collect();
    assert!(errors[0] > 1e-4, "{errors:?}");
    let least = errors.iter().copied().fold(1.0, f64::min);
    assert!(least < 5e-14, "{least:e}");
}
