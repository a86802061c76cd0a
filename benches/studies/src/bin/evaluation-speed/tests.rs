//! The contenders compute the same accelerations.

use branched_pendulum::Pendulum;

use super::accuracy;
use super::articulated::Articulated;
use super::by_hand::ByHand;
use super::dense::Dense;
use super::large::{BUSH_127, Bush127};
use super::scenes::factorization::Paper;
use super::scenes::recursion::{Tree7, Tree31};
use super::states::random;
use super::table::{self, Link};

/// Largest difference over the largest acceleration.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    let largest = expected.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0, |max: f64, (a, b)| max.max((a - b).abs())) / largest
}

fn agree<const N: usize>(model: &impl Pendulum<f64>, links: &[Link]) {
    assert_eq!(links.len(), N);
    let (mut recursion, mut dense) = (Articulated::new(links), Dense::new(links));
    let angles = random(3, N, 100, 3.0).by_state;
    let velocities = random(4, N, 100, 9.0).by_state;
    for (theta, omega) in angles.iter().zip(&velocities) {
        let (mut emitted, mut other) = ([0.0; N], [0.0; N]);
        model.accelerations_into(0.0, theta, omega, &mut emitted);
        recursion.accelerations(theta, omega, &mut other);
        // Rounding errors grow with the condition of the mass matrix, below 10³.
        assert!(
            difference(&other, &emitted) < 1e-12,
            "{other:?} {emitted:?}"
        );
        dense.accelerations(theta, omega, &mut other);
        assert!(
            difference(&other, &emitted) < 1e-12,
            "{other:?} {emitted:?}"
        );
    }
}

#[test]
fn baselines_compute_what_emitted_code_computes() {
    agree::<3>(&Paper::new(), &table::paper());
    agree::<7>(&Tree7::new(), &table::tree(3));
    agree::<31>(&Tree31::new(), &table::tree(5));
    agree::<127>(&Bush127::new(), &table::bush(BUSH_127));
}

#[test]
fn code_by_hand_computes_what_emitted_code_computes() {
    let angles = random(5, 3, 100, 3.0).by_state;
    let velocities = random(6, 3, 100, 9.0).by_state;
    for (theta, omega) in angles.iter().zip(&velocities) {
        let (theta, omega) = (
            [theta[0], theta[1], theta[2]],
            [omega[0], omega[1], omega[2]],
        );
        let emitted = Paper::new().accelerations(&theta, &omega);
        let by_hand = ByHand::default().accelerations(&theta, &omega);
        assert!(difference(&by_hand, &emitted) < 1e-13);
    }
}

/// At least as good as a small multiple of the conditioning bound.
#[test]
fn errors_stay_within_a_small_multiple_of_the_bound() {
    for row in accuracy::all(30) {
        for worst in row.worst.into_iter().flatten() {
            assert!(worst < 5.0, "{row:?}");
        }
        // Emitted code was measured.
        assert!(row.worst[1].is_some_and(|worst| worst > 0.0));
        assert!(row.worst[2].is_some_and(|worst| worst > 0.0));
    }
}
