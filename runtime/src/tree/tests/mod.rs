//! Trees of many shapes: against a dense solve, and in all vectors that the machine
//! has against links taken one by one.

mod bits;
mod dense;
mod energies;
mod equations;
mod pullback;

use alloc::vec::Vec;

use super::{LinkEquations, RootDrive, Tree};
use crate::scalar::Scalar;
use crate::system::Workspace;

/// Numbers between −`size` and `size`.
fn numbers(count: usize, seed: usize, size: f64) -> Vec<f64> {
    let number = |i: usize| (((i + seed) * 7919) % 1009) as f64 / 504.5 - 1.0;
    (0..count).map(|i| size * number(i)).collect()
}

/// Angles, velocities and torques from outside of so many links.
fn motion<T: Scalar>(links: usize) -> [Vec<T>; 3] {
    [(1, 3.0), (500, 2.0), (900, 0.4)].map(|(seed, size)| {
        let numbers = numbers(links, seed, size);
        numbers.into_iter().map(T::from_f64).collect()
    })
}

/// A drive of the root.
fn drive<T: Scalar>() -> RootDrive<T> {
    RootDrive {
        pivot: [0.7, -0.4].map(T::from_f64),
        torque: T::from_f64(0.3),
    }
}

fn accelerations<E: LinkEquations, T: Scalar>(tree: &Tree<E, T>, links: usize) -> Vec<T> {
    let [theta, omega, torques] = motion(links);
    let mut alpha = alloc::vec![T::from_f64(f64::NAN); links];
    let given = [&*theta, &omega, &torques];
    tree.accelerations_under_with(&mut Workspace::new(), Some(drive()), given, &mut alpha);
    alpha
}

#[test]
fn without_torques_from_outside_they_are_zero() {
    let (parents, bodies) = equations::any(64, 1);
    let tree = equations::by_link::<f64>(&parents, &bodies);
    let [theta, omega, _] = motion(64);
    let mut free = [0.0; 64];
    tree.accelerations_into(None, &theta, &omega, &mut free);
    let mut alpha = [0.0; 64];
    let mut workspace = Workspace::new();
    let given = [&*theta, &omega, &[0.0; 64]];
    tree.accelerations_under_with(&mut workspace, None, given, &mut alpha);
    assert_eq!(free, alpha);
    let given = [&*theta, &omega, &[0.0; 63]];
    tree.accelerations_under_with(&mut workspace, None, given, &mut alpha);
    assert!(alpha.iter().all(|alpha| alpha.is_nan()));
}
