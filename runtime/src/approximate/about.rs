//! The linear model of a model.

use alloc::vec;
use alloc::vec::Vec;

use super::error::LinearError;
use super::linear::{Linear, check_size};
use super::matrix::{PreciseMatrix, number};
use super::measured::errors;
use super::slopes::RestSlopes;
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
