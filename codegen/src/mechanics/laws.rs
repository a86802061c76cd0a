//! Energy and dissipation of one element, each law in one function. Whole trees, and single links
//! of trees in loops, use sums of these.

use super::algebra::Formula;
use super::link::{Plane, dot};

/// Returns the kinetic energy ½ (m **V**² + I ω²) of a body with the velocity **V** of its centre
/// of mass.
pub(super) fn kinetic(
    [mass, inertia]: [&Formula; 2],
    velocity: &Plane,
    omega: &Formula,
) -> Formula {
    let moved = mass * &dot(velocity, velocity);
    half(&(&moved + &(inertia * &omega.pow(2))))
}

/// Returns the energy ½ κ ε² of a torsion spring with the strain ε.
pub(super) fn stored(stiffness: &Formula, strain: &Formula) -> Formula {
    half(&(stiffness * &strain.pow(2)))
}

/// Returns the term ½ c w² of Rayleigh's dissipation function, for viscous friction c at the rate
/// w.
pub(super) fn dissipated(friction: &Formula, rate: &Formula) -> Formula {
    half(&(friction * &rate.pow(2)))
}

/// Returns the energy A/ℓⁿ of a power-law force, and its push divided by the distance, n A/ℓⁿ⁺²,
/// given powers of the distance ℓ.
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
