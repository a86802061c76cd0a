//! Equilibria of a tree; small motions about a stable one are described by linear modes.

mod potential;
mod search;
mod stiffness;

pub use potential::{Equilibrium, PotentialEnergy, Stability};
pub use search::{equilibria, equilibrium_at, stable_equilibrium};
pub use stiffness::Stiffness;

use nalgebra::{DMatrix, DVector};

use super::modes::{Modes, ModesError, check_rest, symmetric_matrix};
use super::sector_modes::{SectorModes, SectorModesError};
use crate::approximate::rest::{MOST_STEPS, come_to_rest};
use crate::errors::errors;
use crate::sectors::Sector;

/// Mass matrix, stiffness matrix and accelerations of a tree at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct AtRest<const N: usize> {
    /// Mass matrix M, kg m².
    pub mass: [[f64; N]; N],
    /// Second derivatives of the potential energy by the angles, N m/rad.
    pub stiffness: [[f64; N]; N],
    /// Accelerations from rest, rad/s².
    pub accelerations: [f64; N],
}

impl<const N: usize> AtRest<N> {
    /// Returns the torques M α (N m) on the links at rest, with the mass matrix M and accelerations
    /// α: zero at an equilibrium.
    pub fn torques(&self) -> [f64; N] {
        let product = |row: &[f64; N]| {
            let terms = row.iter().zip(&self.accelerations);
            terms.map(|(mass, alpha)| mass * alpha).sum()
        };
        self.mass.each_ref().map(product)
    }

    /// Returns the linear modes about these angles.
    ///
    /// # Errors
    ///
    /// As [`Modes::at_rest`].
    pub fn modes(&self) -> Result<Modes, ModesError> {
        Modes::at_rest(&self.mass, &self.stiffness, &self.torques())
    }

    /// Returns the linear modes about these angles, sector by sector.
    ///
    /// # Errors
    ///
    /// As [`SectorModes::new`], and [`ModesError::NotAtRest`] among the
    /// [`SectorModesError::Matrices`].
    pub fn sector_modes(&self, sectors: &[Sector]) -> Result<SectorModes, SectorModesError> {
        let stiffness = symmetric_matrix("stiffness", &self.stiffness)?;
        check_rest(&stiffness, &self.torques())?;
        SectorModes::new(sectors, &self.mass, &self.stiffness)
    }
}

/// Finds the equilibrium near `start`, at which the tree stays at rest, by Newton's method: K δ = M
/// α, since the torques at rest are M α = −∂U/∂θ. No angle changes by more than half a radian per
/// step. The equilibrium may be unstable, as [`Modes`] reports: [`stable_equilibrium`] descends to
/// a stable one.
///
/// # Errors
///
/// [`EquilibriumError`] if the stiffness becomes singular or not finite during the search, or if
/// 100 steps do not suffice.
///
/// # Examples
///
/// A rod held up by a spring whose rest angle is 0.2 rad from the upward vertical:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::analysis::{AtRest, equilibrium};
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
/// let at = |theta: &[f64; 1]| AtRest {
///     mass: reed.mass_matrix(theta),
///     stiffness: reed.stiffness_matrix(theta),
///     accelerations: reed.accelerations(theta, &[0.0]),
/// };
/// let theta = equilibrium([0.0], at)?;
/// // It leans further than the spring alone would have it.
/// assert!((theta[0] - 0.6381).abs() < 1e-3, "{theta:?}");
/// assert!(reed.accelerations(&theta, &[0.0])[0].abs() < 1e-12);
/// assert!(at(&theta).modes()?.frequencies_hz[0] > 0.5);
/// assert!(at(&[0.0]).modes().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn equilibrium<const N: usize>(
    start: [f64; N],
    mut at: impl FnMut(&[f64; N]) -> AtRest<N>,
) -> Result<[f64; N], EquilibriumError> {
    let at = |angles: &[f64]| {
        let mut theta = start;
        theta.copy_from_slice(angles);
        let at = at(&theta);
        // Asked for, since a step by a mass matrix that is none would be wrong.
        symmetric_matrix("mass", &at.mass)?;
        Ok((at.stiffness.to_vec(), at.torques().to_vec()))
    };
    let found = equilibrium_of_torques(&start, at)?;
    let mut theta = start;
    theta.copy_from_slice(&found);
    Ok(theta)
}

/// Finds the equilibrium near `start` like [`equilibrium`], for any number of angles. `at` returns
/// the rows of the stiffness matrix K and the torques τ of the system at rest, from which a step δ
/// is computed by K δ = τ.
///
/// # Errors
///
/// Errors of `at`, and as [`equilibrium`].
pub fn equilibrium_of_torques<R: AsRef<[f64]>>(
    start: &[f64],
    mut at: impl FnMut(&[f64]) -> Result<(Vec<R>, Vec<f64>), ModesError>,
) -> Result<Vec<f64>, EquilibriumError> {
    let mut theta = start.to_vec();
    let last_step = come_to_rest(&mut start.to_vec(), |angles| {
        theta.copy_from_slice(angles);
        let (stiffness, torques) = at(angles).map_err(EquilibriumError::Matrix)?;
        let stiffness: DMatrix<f64> =
            symmetric_matrix("stiffness", &stiffness).map_err(EquilibriumError::Matrix)?;
        let (torques, rows) = (DVector::from_vec(torques), stiffness.nrows());
        if torques.len() != rows {
            let torques = torques.len();
            return Err(EquilibriumError::Matrix(ModesError::Torques {
                torques,
                rows,
            }));
        }
        let step = stiffness.lu().solve(&torques);
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
    /// Reason why no equilibrium was found.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum EquilibriumError {
        /// A matrix contains an infinite or NaN entry, or is not symmetric.
        Matrix(error: ModesError) => "{error}",
        /// The stiffness matrix is singular, or a torque is infinite or NaN.
        Singular => "the stiffness matrix became singular during the search for an equilibrium: \
            start from other angles",
        /// Newton's method did not converge: its steps did not become small.
        NoConvergence {
            /// Largest change of an angle in the last step, rad.
            last_step: f64,
        } => "found no equilibrium within {MOST_STEPS} steps (the last one was {last_step} rad): \
            start from other angles",
        /// Energy, torques or stiffness become infinite or NaN at the start or during the search.
        NotFinite => "the potential energy or its derivatives became infinite or NaN during the \
            search for an equilibrium, as where the ends of a straight spring meet: start from \
            other angles",
        /// The descent of the potential energy found no minimum.
        NoMinimum {
            /// Largest change of an angle in the last step, rad.
            last_step: f64,
        } => "the potential energy decreases without reaching a minimum (the last step was \
            {last_step} rad), as under an unbounded attraction: start from other angles",
    }
}

impl core::error::Error for EquilibriumError {}
