//! Equilibria of a tree, about which its linear modes are those of small motions.

use nalgebra::{DMatrix, DVector};

use super::modes::{ModesError, symmetric_matrix};
use crate::approximate::rest::{MOST_STEPS, come_to_rest};
use crate::errors::errors;

/// Matrices of a tree at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct AtRest<const N: usize> {
    /// Mass matrix M, kg m².
    pub mass: [[f64; N]; N],
    /// Second derivatives of the potential energy, N m/rad.
    pub stiffness: [[f64; N]; N],
    /// Accelerations from rest, rad/s².
    pub accelerations: [f64; N],
}

/// Finds the equilibrium near `start`, at which the tree stays at rest, by Newton's
/// method: K δ = M α, since the torques at rest are M α = −∂U/∂θ. No angle changes by
/// more than half a radian at once. It may be unstable: [`Modes`](super::Modes) says so.
///
/// # Errors
///
/// [`EquilibriumError`] if the stiffness is singular or not finite on the way, or if
/// 100 steps do not suffice.
///
/// # Examples
///
/// A rod held up by a spring that is at rest at 0.2 rad from the upward vertical:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::{AtRest, Modes, equilibrium};
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = -9.80665,
///     reed: rod(mass = 0.1, length = 0.3, spring = 0.2, rest = 0.2),
///     emit(modes),
/// )]
/// struct Reed;
///
/// let reed = Reed::new();
/// let theta = equilibrium([0.0], |theta| AtRest {
///     mass: reed.mass_matrix(theta),
///     stiffness: reed.stiffness_matrix(theta),
///     accelerations: reed.accelerations(theta, &[0.0]),
/// })?;
/// // It leans further than the spring alone would have it.
/// assert!((theta[0] - 0.6381).abs() < 1e-3, "{theta:?}");
/// assert!(reed.accelerations(&theta, &[0.0])[0].abs() < 1e-12);
/// let modes = Modes::new(&reed.mass_matrix(&theta), &reed.stiffness_matrix(&theta))?;
/// assert!(modes.frequencies_hz[0] > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn equilibrium<const N: usize>(
    start: [f64; N],
    mut at: impl FnMut(&[f64; N]) -> AtRest<N>,
) -> Result<[f64; N], EquilibriumError> {
    let mut theta = start;
    let last_step = come_to_rest(&mut start.to_vec(), |angles| {
        theta.copy_from_slice(angles);
        let AtRest {
            mass,
            stiffness,
            accelerations,
        } = at(&theta);
        let mass = symmetric_matrix("mass", &mass).map_err(EquilibriumError::Matrix)?;
        let stiffness: DMatrix<f64> =
            symmetric_matrix("stiffness", &stiffness).map_err(EquilibriumError::Matrix)?;
        let torque = mass * DVector::from_column_slice(&accelerations);
        let step = stiffness.lu().solve(&torque);
        let step = step.filter(|step| step.iter().all(|part| part.is_finite()));
        let step = step.ok_or(EquilibriumError::Singular)?;
        Ok(step.as_slice().to_vec())
    })?;
    match last_step {
        None => Ok(theta),
        Some(last_step) => Err(EquilibriumError::NoConvergence { last_step }),
    }
}

errors! {
    /// Reason for which no equilibrium was found.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum EquilibriumError {
        /// A matrix is not finite or not symmetric.
        Matrix(error: ModesError) => "{error}",
        /// The stiffness is singular, or torques are not finite.
        Singular => "the stiffness is singular on the way to an equilibrium: start elsewhere",
        /// The steps did not become small.
        NoConvergence {
            /// Largest change of an angle in the last step, rad.
            last_step: f64,
        } => "no equilibrium within {MOST_STEPS} steps, the last one of {last_step} rad: start \
            elsewhere",
    }
}

impl core::error::Error for EquilibriumError {}
