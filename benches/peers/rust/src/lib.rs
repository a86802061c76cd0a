//! Shared code of the comparisons with other tools: our trees as emitted code, the motions of the
//! studies with their references, and our accelerations for programs in C.

#[rustfmt::skip]
#[path = "../expanded.rs"]
pub mod scenes;
pub mod measure;
pub mod work_precision;

use std::slice;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use scenes::{BranchedDouble, Rods, ThirtyOneRods};

/// Evaluates the accelerations of all states one after the other.
fn each<P: Pendulum<f64>>(model: &P, given: [&[f64]; 2], alpha: &mut [f64]) {
    let n = model.links();
    let [theta, omega] = given.map(|values| values.chunks_exact(n));
    for ((theta, omega), alpha) in theta.zip(omega).zip(alpha.chunks_exact_mut(n)) {
        model.accelerations_into(0.0, theta, omega, alpha);
    }
}

/// Evaluates the accelerations of all states with 31 digits, and rounds them.
fn each_exactly<P: Pendulum<Double>>(model: &P, given: [&[f64]; 2], alpha: &mut [f64]) {
    let n = model.links();
    let wide =
        |values: &[f64]| -> Vec<Double> { values.iter().copied().map(Double::from_f64).collect() };
    let [theta, omega] = given.map(|values| values.chunks_exact(n));
    let mut exact = vec![Double::from_f64(0.0); n];
    for ((theta, omega), alpha) in theta.zip(omega).zip(alpha.chunks_exact_mut(n)) {
        model.accelerations_into(
            Double::from_f64(0.0),
            &wide(theta),
            &wide(omega),
            &mut exact,
        );
        for (alpha, exact) in alpha.iter_mut().zip(&exact) {
            *alpha = exact.high();
        }
    }
}

/// Writes the accelerations (rad/s²) of our tree of `links` links for `states` states. Angles (rad)
/// and velocities (rad/s) are absolute, state after state. Returns 0, or 1 if there is no tree with
/// this number of links.
///
/// # Safety
/// The three arrays must have `states * links` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn accelerations(
    links: usize,
    states: usize,
    theta: *const f64,
    omega: *const f64,
    alpha: *mut f64,
    is_exact: bool,
) -> i32 {
    let numbers = links * states;
    let (given, alpha) = unsafe {
        let given = [theta, omega].map(|values| slice::from_raw_parts(values, numbers));
        (given, slice::from_raw_parts_mut(alpha, numbers))
    };
    match (links, is_exact) {
        (3, false) => each(&BranchedDouble::new(), given, alpha),
        (7, false) => each(&Rods::new(), given, alpha),
        (31, false) => each(&ThirtyOneRods::new(), given, alpha),
        (3, true) => each_exactly(&BranchedDouble::<Double>::default(), given, alpha),
        (7, true) => each_exactly(&Rods::<Double>::default(), given, alpha),
        (31, true) => each_exactly(&ThirtyOneRods::<Double>::default(), given, alpha),
        _ => return 1,
    }
    0
}
