//! Energies and losses of one link, each law once: of whole trees and of one link in loops
//! they are sums of these.

use super::algebra::Formula;
use super::link::{Plane, dot};

/// Kinetic energy ½ (m **V**² + I ω²) of a body with the velocity **V** of its centre of mass.
pub(super) fn kinetic(
    [mass, inertia]: [&Formula; 2],
    velocity: &Plane,
    omega: &Formula,
) -> Formula {
    let moved = mass * &dot(velocity, velocity);
    half(&(&moved + &(inertia * &omega.pow(2))))
}

/// Energy ½ κ ε² of a torsion spring.
pub(super) fn stored(stiffness: &Formula, strain: &Formula) -> Formula {
    half(&(stiffness * &strain.pow(2)))
}

/// Term ½ c w² of Rayleigh's dissipation function: viscous friction at the rate w.
pub(super) fn dissipated(friction: &Formula, rate: &Formula) -> Formula {
    half(&(friction * &rate.pow(2)))
}

/// Energy A/ℓⁿ of a force by a power of the distance, and its push over the distance, n A/ℓⁿ⁺²,
/// given the powers of ℓ.
pub(super) fn inverse_power(
    strength: &Formula,
    exponent: i32,
    distance_to: impl Fn(i32) -> Formula,
) -> [Formula; 2] {
    let push = &Formula::integer(exponent.into()) * &distance_to(-exponent - 2);
    [strength * &distance_to(-exponent), strength * &push]
}

fn half(formula: &Formula) -> Formula {
    &Formula::integer(2).pow(-1) * formula
}
