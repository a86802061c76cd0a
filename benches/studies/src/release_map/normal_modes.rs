//! The nonlinear normal modes of the paper's pendulum in phase.

use branched_pendulum::analysis::Modes;
use branched_pendulum::analysis::growth::{BrakeOrbit, Continuation, Floquet};
use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::prelude::*;

use crate::critical_angle::scene::{InPhase, first_sector};
use branched_pendulum_frame::Failure;

/// A mode, from its linear oscillation on.
#[derive(Clone, Debug)]
pub struct NormalMode {
    /// Sign of the mode in the paper: f_+ is the slower one.
    pub sign: char,
    /// Frequency of small motions, Hz.
    pub frequency_hz: f64,
    /// Shape of small motions: parts of parent and children with unit momenta.
    pub shape: [f64; 2],
    /// Motions of the mode, from small to large.
    pub orbits: Vec<BrakeOrbit>,
    /// Growth of differences along each.
    pub floquet: Vec<Floquet>,
}

/// Tolerance of the integrations.
const TOLERANCE: f64 = 1e-10;

/// Longest step along a mode, rad.
const STEP: f64 = 0.04;

/// The modes up to the largest angle, degrees.
///
/// # Errors
/// [`Failure::Modes`] or [`Failure::Growth`].
pub fn of(model: &InPhase, largest: f64) -> Result<Vec<NormalMode>, Failure> {
    let rest = [0.0; 2];
    let modes = Modes::new(&model.mass_matrix(&rest), &model.stiffness_matrix(&rest))?;
    let system = linearised(AbsoluteAngles(model));
    let ode = first_sector(model)?;
    let continuation = Continuation {
        tolerance: TOLERANCE,
        step: STEP,
        largest: largest.to_radians(),
    };
    let all = modes
        .frequencies_hz
        .iter()
        .zip(&modes.shapes)
        .zip(['+', '−']);
    all.map(|((&frequency_hz, shape), sign)| {
        let orbits = continuation.orbits(&system, &rest, shape, frequency_hz)?;
        let floquet = orbits
            .iter()
            .map(|orbit| Floquet::of_differences(&ode, orbit, TOLERANCE));
        Ok(NormalMode {
            sign,
            frequency_hz,
            shape: [shape[0], shape[1]],
            floquet: floquet.collect::<Result<_, _>>()?,
            orbits,
        })
    })
    .collect()
}

impl NormalMode {
    /// The curve of releases through the plane, to both sides: children and parent,
    /// degrees.
    pub fn curve(&self) -> (Vec<f64>, Vec<f64>) {
        let one = self
            .orbits
            .iter()
            .map(|orbit| [orbit.release[1], orbit.release[0]]);
        let one: Vec<[f64; 2]> = one.collect();
        let other = one.iter().rev().map(|point| point.map(|angle| -angle));
        let all = other.chain([[0.0; 2]]).chain(one.iter().copied());
        all.map(|point| point.map(f64::to_degrees))
            .map(|[x, y]| (x, y))
            .unzip()
    }

    /// Part of this mode in angles or rates, M being the mass matrix at rest.
    pub fn part(&self, mass: &[[f64; 2]; 2], values: [f64; 2]) -> f64 {
        let [a, b] = self.shape;
        let [[m, n], [_, p]] = mass;
        a * (m * values[0] + n * values[1]) + b * (n * values[0] + p * values[1])
    }
}
