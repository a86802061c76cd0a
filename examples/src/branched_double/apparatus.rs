//! The paper's pendulum, and the quantities that are measured on it at one instant.
//!
//! Coordinates are the symmetric ones, in the order θ_1, θ_m, θ_d: the angle of the parent, and the
//! mean and half the difference of the children's angles. SI units, angles in radians.

use std::array;
use std::f64::consts::{FRAC_PI_2, PI};

use branched_pendulum::prelude::*;

/// The paper's apparatus, with viscous friction in its joints (N m s).
///
/// Lengths and masses were measured, the moments of inertia fitted to the three eigenfrequencies
/// (the paper, sections 4 and 5). The paper does not state g; for a motion that starts from rest,
/// another g only changes the time scale.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction_root) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction_children) * 2
    ],
    emit(energies, momenta, modes, symmetric, positions, transfer(angle = 1, amplitude = 2, exact)),
)]
pub struct BranchedDouble;

/// Names of the forms of W: to first order in θ_d as published, the complete quadratic form in
/// (θ_d, p_d), and exact.
pub const FORMS: [&str; 3] = ["angle 1", "amplitude 2", "exact"];

/// Index of the published form in [`FORMS`].
pub const PUBLISHED: usize = 0;

/// Index of the exact form in [`FORMS`].
pub const EXACT: usize = 2;

/// Number of powers in [`AntiphasePowers`].
pub const POWERS: usize = 7;

/// Powers into the antiphase energy H_d, in W; integrated over time, energies in J: W_K and W_P of
/// each of [`FORMS`], and the power of friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AntiphasePowers(pub [f64; POWERS]);

impl AntiphasePowers {
    /// Returns the energy transfer W according to the form with this index in [`FORMS`].
    pub fn transfer(&self, form: usize) -> Transfer<f64> {
        let [kinetic, potential] = [2 * form, 2 * form + 1].map(|index| self.0[index]);
        Transfer { kinetic, potential }
    }

    /// Returns the power of friction.
    pub fn friction(&self) -> f64 {
        self.0[6]
    }

    /// Returns dH_d/dt, the sum of W according to this form and of the power of friction.
    pub fn total(&self, form: usize) -> f64 {
        self.transfer(form).total() + self.friction()
    }
}

/// All quantities at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time since the release.
    pub time: f64,
    /// Angles θ_1, θ_2, θ_3 of the links.
    pub theta: [f64; 3],
    /// Rates of the angles.
    pub omega: [f64; 3],
    /// Mean angle θ_m of the children.
    pub mean: f64,
    /// Half the difference θ_d of the children's angles.
    pub difference: f64,
    /// Rates of θ_1, θ_m, θ_d.
    pub rates: [f64; 3],
    /// Momenta p_1, p_m, p_d.
    pub momenta: [f64; 3],
    /// Antiphase energy H_d.
    pub antiphase_energy: f64,
    /// Total energy H, zero if all links hang at rest.
    pub energy: f64,
    /// Powers into H_d at this time.
    pub powers: AntiphasePowers,
    /// Integrals of the powers since the release.
    pub supplied: AntiphasePowers,
    /// Terms of W's leading order, a quadratic form in (θ_d, p_d): first the two of the published
    /// form, p_d² and the potential part of p_d θ_d; then the two that it lacks, the kinetic part of
    /// p_d θ_d and θ_d².
    pub terms: [f64; 4],
}

impl BranchedDouble {
    /// Computes the powers at coordinates with these rates.
    pub fn powers(&self, coordinates: &[f64; 3], rates: &[f64; 3]) -> AntiphasePowers {
        let momenta = self.symmetric_momenta(coordinates, rates);
        let published = self.transfer_angle_1(coordinates, &momenta);
        let quadratic = self.transfer_amplitude_2(coordinates, &momenta);
        let exact = self.transfer_exact_from_rates(coordinates, rates);
        // A sum, because minus zero would show in tables.
        let friction = 0.0 + self.antiphase_friction_power_from_rates(coordinates, rates);
        AntiphasePowers([
            published.kinetic,
            published.potential,
            quadratic.kinetic,
            quadratic.potential,
            exact.kinetic,
            exact.potential,
            friction,
        ])
    }

    /// Computes all quantities at a time after the release. The state consists of coordinates,
    /// their rates, and the integrals of the powers.
    pub fn measure(&self, time: f64, state: &[f64]) -> Sample {
        let (coordinates, rates, supplied) = parts(state);
        let momenta = self.symmetric_momenta(&coordinates, &rates);
        let powers = self.powers(&coordinates, &rates);
        let [_, mean, difference] = coordinates;
        let [_, pq, qq] = self.transfer_quadratic_form(&coordinates, &momenta);
        let published = powers.transfer(PUBLISHED);
        Sample {
            time,
            theta: self.from_symmetric(&coordinates),
            omega: self.from_symmetric(&rates),
            mean,
            difference,
            rates,
            momenta,
            antiphase_energy: self.antiphase_energy(&coordinates, &momenta),
            energy: self.hamiltonian(&coordinates, &momenta),
            powers,
            supplied,
            terms: [
                published.kinetic,
                published.potential,
                pq * momenta[2] * difference - published.potential,
                qq * difference * difference,
            ],
        }
    }
}

/// Splits a state into coordinates, their rates, and the integrals of the powers.
pub fn parts(state: &[f64]) -> ([f64; 3], [f64; 3], AntiphasePowers) {
    let at = |index: usize| state.get(index).copied().unwrap_or(f64::NAN);
    let supplied = AntiphasePowers(array::from_fn(|index| at(index + 6)));
    (
        array::from_fn(at),
        array::from_fn(|index| at(index + 3)),
        supplied,
    )
}

/// Returns the angle between −π/2 and π/2 that differs from the given one by a multiple of π. θ_d
/// is defined only up to multiples of π, because θ_2 and θ_3 are defined up to multiples of 2π.
pub fn folded(angle: f64) -> f64 {
    (angle - PI * (angle / PI).round()).clamp(-FRAC_PI_2, FRAC_PI_2)
}
