//! The linear model of a model.

use alloc::vec;
use alloc::vec::Vec;

use super::error::LinearError;
use super::linear::{Linear, check_size};
use super::matrix::{PreciseMatrix, number};
use super::measured::errors;
use super::rest::come_to_rest;
use crate::integrate::Factored;
use crate::scalar::Dual;
use crate::system::{Energy, Pendulum, Workspace};

/// Errors of matrices that come from accelerations, relative.
const ROUNDING: f64 = 1e-10;

impl Linear {
    /// The model of small motions about the equilibrium next to the angles `near` (rad),
    /// with the errors that it has there: each mode alone is followed for a second at
    /// two small amplitudes, by this model and by the full one.
    ///
    /// # Errors
    ///
    /// [`LinearError`], if there is no equilibrium at which torques depend on angles and
    /// rates in the symmetric way of springs and friction.
    pub fn about<P>(model: &P, near: &[f64]) -> Result<Self, LinearError>
    where
        P: Pendulum<f64>,
        P::Of<Dual<f64, 1>>: Energy<Dual<f64, 1>>,
    {
        if near.len() != model.links() {
            return Err(LinearError::Length {
                name: "near",
                expected: model.links(),
                found: near.len(),
            });
        }
        check_size(model.links())?;
        let dual = model.cast(Dual::<f64, 1>::constant);
        let slopes = RestSlopes::at_rest(&dual, near)?;
        let mass = mass(&dual, &slopes.equilibrium);
        let negative = |entries: &[f64]| {
            let slopes = PreciseMatrix::new(near.len(), near.len(), |row, column| {
                -number(entries[row * near.len() + column])
            });
            mass.times(&slopes)
        };
        let (stiffness, damping) = (negative(&slopes.by_angles), negative(&slopes.by_rates));
        let equilibrium = slopes.equilibrium.clone();
        let mut linear = Self::new(equilibrium, [mass, stiffness, damping], ROUNDING)?;
        linear.errors = errors(model, &linear, &slopes);
        Ok(linear)
    }
}

/// An equilibrium and the derivatives of accelerations there, row by row.
pub(super) struct RestSlopes {
    pub(super) equilibrium: Vec<f64>,
    pub(super) by_angles: Vec<f64>,
    pub(super) by_rates: Vec<f64>,
}

impl RestSlopes {
    /// Searches for rest next to the angles `near`.
    fn at_rest(model: &impl Pendulum<Dual<f64, 1>>, near: &[f64]) -> Result<Self, LinearError> {
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
            // At rest already: there may be no stiffness at all.
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

    /// Derives at the present angles, and returns the accelerations.
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

/// The mass matrix: ∂K/∂ω_i at the rates that have one at link j alone.
fn mass(model: &impl Energy<Dual<f64, 1>>, angles: &[f64]) -> PreciseMatrix {
    let n = angles.len();
    let constant = |&angle: &f64| Dual::<f64, 1>::constant(angle);
    let theta: Vec<_> = angles.iter().map(constant).collect();
    let mut omega = vec![Dual::constant(0.0); n];
    let mut workspace = Workspace::new();
    let mut entry = |i: usize, j: usize| {
        omega[j].value = 1.0;
        omega[i].tangents = [1.0];
        let energy = model.kinetic_energy_with(&mut workspace, &theta, &omega);
        omega[j].value = 0.0;
        omega[i].tangents = [0.0];
        energy.tangents[0]
    };
    let mut lower = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            lower[i * n + j] = entry(i, j);
        }
    }
    PreciseMatrix::new(n, n, |i, j| number(lower[i.max(j) * n + i.min(j)]))
}
