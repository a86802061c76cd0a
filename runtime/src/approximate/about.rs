//! Linear model of small motions, derived from a compiled model of a tree.

use alloc::vec;
use alloc::vec::Vec;

use super::error::LinearError;
use super::linear::{Linear, check_size};
use super::matrix::{PreciseMatrix, number};
use super::measured::errors;
use super::slopes::RestSlopes;
use crate::scalar::Dual;
use crate::system::{Energy, Pendulum, Workspace};

/// Relative rounding error of matrices that are derived from accelerations.
const ROUNDING: f64 = 1e-10;

impl Linear {
    /// Returns the linear model of small motions about the equilibrium closest to the angles `near`
    /// (rad).
    ///
    /// It also measures the error of each mode, by computing the motion of the mode alone for one
    /// second at two small amplitudes with the linear and the full model.
    ///
    /// # Errors
    ///
    /// Returns [`LinearError`] if no equilibrium is found, or if torques there do not depend on
    /// angles and rates in the symmetric way of springs and friction.
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

/// Returns the mass matrix (kg m²): entry (i, j) is the derivative ∂K/∂ω_i of the kinetic energy K
/// if only link j rotates, at 1 rad/s.
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
