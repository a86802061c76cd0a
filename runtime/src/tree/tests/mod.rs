//! Trees of many shapes: against a dense solve, and in all vectors that the machine
//! has against links taken one by one.

mod bits;
mod dense;
mod equations;

use alloc::vec::Vec;

use super::{LinkEquations, RootDrive, Tree};
use crate::scalar::Scalar;

/// Numbers between −`size` and `size`.
fn numbers(count: usize, seed: usize, size: f64) -> Vec<f64> {
    let number = |i: usize| (((i + seed) * 7919) % 1009) as f64 / 504.5 - 1.0;
    (0..count).map(|i| size * number(i)).collect()
}

/// Angles and velocities of so many links.
fn motion<T: Scalar>(links: usize) -> [Vec<T>; 2] {
    [(1, 3.0), (500, 2.0)].map(|(seed, size)| {
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
    let [theta, omega] = motion(links);
    let mut alpha = alloc::vec![T::from_f64(f64::NAN); links];
    tree.accelerations_into(Some(drive()), &theta, &omega, &mut alpha);
    alpha
}
