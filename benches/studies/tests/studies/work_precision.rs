//! References of the studies of accuracy against cost.

use branched_pendulum::prelude::*;
use branched_pendulum_studies::scenes::Rods;
use branched_pendulum_studies::work_precision::reference::{RODS, papers, problems, rods_at};

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
    let problems = problems(&[10.0]).unwrap();
    assert_eq!(problems.len(), 3);
    let found = &problems[2].expected;
    let other = rods_at(10.0, 1e-28).unwrap();
    let method = Verner98::new(Options::with_tolerance(1e-14));
    let (model, start) = (Rods::new(), State::at_rest(0.0, &RODS));
    let verner = method.run(&AbsoluteAngles(&model), &start, 10.0).unwrap();
    for ((found, other), verner) in found.iter().zip(&other).zip(&verner.state.values) {
        assert!((found - other).abs() <= f64::EPSILON * found.abs());
        assert!((found - verner).abs() < 1e-11, "{found} {verner}");
    }
}
