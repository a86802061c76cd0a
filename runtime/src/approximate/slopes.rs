//! Search for an equilibrium, and the derivatives of the accelerations there.

use alloc::vec;
use alloc::vec::Vec;

use super::error::LinearError;
use super::rest::come_to_rest;
use crate::integrate::Factored;
use crate::scalar::Dual;
use crate::system::{Pendulum, Workspace};

/// Equilibrium (angles in rad) and the derivatives of the accelerations there by angles and by
/// angular velocities, as matrices stored row by row.
pub(super) struct RestSlopes {
    pub(super) equilibrium: Vec<f64>,
    pub(super) by_angles: Vec<f64>,
    pub(super) by_rates: Vec<f64>,
}

impl RestSlopes {
    /// Searches for an equilibrium near the angles `near` (rad), and returns it with the
    /// derivatives of the accelerations.
    pub(super) fn at_rest(
        model: &impl Pendulum<Dual<f64, 1>>,
        near: &[f64],
    ) -> Result<Self, LinearError> {
        let n = near.len();
        let zeros = || vec![0.0; n * n];
        let mut slopes = Self {
            equilibrium: near.to_vec(),
            by_angles: zeros(),
            by_rates: zeros(),
        };
        let last = come_to_rest(&mut near.to_vec(), |angles| {
            slopes.equilibrium.copy_from_slice(angles);
            let mut step = slopes.derive(model);
            if !step.iter().chain(&slopes.by_angles).all(|a| a.is_finite()) {
                return Err(LinearError::NotFinite);
            }
            // The tree is at rest already; the stiffness may be zero, so that it could not be
            // factorised.
            if step.iter().all(|&acceleration| acceleration == 0.0) {
                return Ok(step);
            }
            let mut factored = Factored::new(n);
            factored.entries.copy_from_slice(&slopes.by_angles);
            if !factored.factorise() {
                return Err(LinearError::NoEquilibrium);
            }
            factored.solve(&mut step);
            step.iter_mut().for_each(|part| *part = -*part);
            Ok(step)
        })?;
        match last {
            None => Ok(slopes),
            Some(_) => Err(LinearError::NoEquilibrium),
        }
    }

    /// Computes the derivatives of the accelerations at the equilibrium, and returns the
    /// accelerations (rad/s²) there.
    fn derive(&mut self, model: &impl Pendulum<Dual<f64, 1>>) -> Vec<f64> {
        let n = self.equilibrium.len();
        let angles = self.equilibrium.iter();
        let mut theta: Vec<_> = angles
            .map(|&angle| Dual::<f64, 1>::constant(angle))
            .collect();
        let mut omega = vec![Dual::constant(0.0); n];
        let mut alpha = omega.clone();
        let mut workspace = Workspace::new();
        for column in 0..2 * n {
            let (moved, slopes) = if column < n {
                (&mut theta, &mut self.by_angles)
            } else {
                (&mut omega, &mut self.by_rates)
            };
            moved[column % n].tangents = [1.0];
            let time = Dual::constant(0.0);
            model.accelerations_with(&mut workspace, time, &theta, &omega, &mut alpha);
            for (row, alpha) in alpha.iter().enumerate() {
                slopes[row * n + column % n] = alpha.tangents[0];
            }
            let moved = if column < n { &mut theta } else { &mut omega };
            moved[column % n].tangents = [0.0];
        }
        alpha.iter().map(|alpha| alpha.value).collect()
    }
}
