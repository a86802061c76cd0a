//! Potential energies and their equilibria.

use super::stiffness::Stiffness;

/// The potential energy of a system with any number of angles, and its derivatives.
pub trait PotentialEnergy {
    /// Number of angles.
    fn angles(&self) -> usize;

    /// Returns the energy, J, at angles in rad.
    fn energy(&self, theta: &[f64]) -> f64;

    /// Returns the torques −∂U/∂θ (N m) and the stiffness matrix (N m/rad), the second derivatives
    /// of the energy U.
    fn torques_and_stiffness(&self, theta: &[f64]) -> (Vec<f64>, Stiffness);
}

/// Stability of an equilibrium, from the second derivatives of the potential energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stability {
    /// The energy has a minimum.
    Stable,
    /// The energy decreases in some direction.
    Unstable,
    /// The energy decreases in no direction, but in some direction it does not increase to second
    /// order.
    Neutral,
}

/// Equilibrium: angles at which a system stays at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Angles, rad.
    pub theta: Vec<f64>,
    /// Potential energy, J.
    pub energy: f64,
    /// Stability.
    pub stability: Stability,
}
