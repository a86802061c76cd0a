//! Quantities measured on the apparatus at one instant.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use branched_pendulum::{ParameterError, Transfer};
use clap::Args;

use super::scenes::{BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters};
use branched_pendulum_frame::command_line::{number, plain};

/// Coefficients of viscous friction in the joints, in N m s: the torque is minus the coefficient
/// times the angular velocity relative to the parent link (for the root, to the ground).
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
pub struct Friction {
    /// viscous friction in the parent's pivot, N m s from 0 to 1
    #[arg(
        long = "friction-root",
        id = "friction-root",
        value_name = "C",
        default_value = "0",
        value_parser = number(0.0..=1.0, "N m s"),
        allow_hyphen_values = true
    )]
    pub root: f64,
    /// viscous friction in each child's pivot, N m s from 0 to 1; 3.5e-5
    /// brings onset and peak near the paper's
    #[arg(
        verbatim_doc_comment,
        long = "friction-children",
        id = "friction-children",
        value_name = "C",
        default_value = "0",
        value_parser = number(0.0..=1.0, "N m s"),
        allow_hyphen_values = true
    )]
    pub children: f64,
}

impl Friction {
    /// Returns true if both coefficients are zero.
    pub fn is_zero(self) -> bool {
        self.root == 0.0 && self.children == 0.0
    }

    /// Returns the parameters of the scene with friction.
    pub fn parameters(self) -> DampedBranchedDoubleParameters<f64> {
        DampedBranchedDoubleParameters {
            friction_root: self.root,
            friction_children: self.children,
        }
    }
}

impl fmt::Display for Friction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { root, children } = *self;
        if self.is_zero() {
            return write!(f, "no friction");
        }
        let (root, children) = (plain(root), plain(children));
        write!(f, "friction {root} (root), {children} (children) N·m·s")
    }
}

/// The apparatus in double precision, for measuring.
///
/// Energies, momenta and W do not depend on friction: they are those of
/// [`BranchedDouble`] for both scenes.
#[derive(Clone, Copy, Debug)]
pub struct Apparatus {
    ideal: BranchedDouble,
    damped: Option<DampedBranchedDouble>,
    friction: Friction,
}

/// Power (W) that flows into the antiphase mode and out of the whole pendulum; integrated over
/// time, energy (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flow {
    /// Power W into H_d in the three forms of [`FORMS`], each split into kinetic and potential
    /// part.
    pub transfer: [Transfer<f64>; 3],
    /// Power of friction on H_d.
    pub antiphase_friction: f64,
    /// Power of friction on the total energy; never positive.
    pub friction: f64,
}

/// The forms of W, in the order of [`Flow::transfer`]: to first order in θ_d as
/// published, the complete quadratic form in (θ_d, p_d), and exact.
pub const FORMS: [&str; 3] = ["angle 1", "amplitude 2", "exact"];

/// Index of the published form in [`FORMS`].
pub const PUBLISHED: usize = 0;

/// Index of the exact form in [`FORMS`].
pub const EXACT: usize = 2;

/// Index of θ_m (mean angle of the children) among the symmetric coordinates (θ_1, θ_m, θ_d).
pub const MEAN: usize = 1;

/// Index of θ_d (half the difference of the children's angles) among the symmetric coordinates.
pub const DIFFERENCE: usize = 2;

/// All quantities at one instant, in SI units, with angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time since the release.
    pub time: f64,
    /// θ_1, θ_2, θ_3.
    pub theta: [f64; 3],
    /// Their rates.
    pub omega: [f64; 3],
    /// θ_1, θ_m, θ_d.
    pub coordinates: [f64; 3],
    /// Their rates.
    pub rates: [f64; 3],
    /// p_1, p_m, p_d.
    pub momenta: [f64; 3],
    /// H_d.
    pub antiphase_energy: f64,
    /// Total energy H, zero if all links hang at rest.
    pub energy: f64,
    /// Energy transfer W and the power of friction.
    pub flow: Flow,
}

/// Returns the angle between −π/2 and π/2 that differs from the given one by a multiple of π. θ_d
/// is defined only up to multiples of π, because θ_2 and θ_3 are defined up to multiples of 2π.
pub fn folded(angle: f64) -> f64 {
    (angle - PI * (angle / PI).round()).clamp(-FRAC_PI_2, FRAC_PI_2)
}

impl Apparatus {
    /// Creates the apparatus with this friction.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite.
    pub fn new(friction: Friction) -> Result<Self, ParameterError> {
        let damped = if friction.is_zero() {
            None
        } else {
            Some(DampedBranchedDouble::new(friction.parameters())?)
        };
        Ok(Self {
            ideal: BranchedDouble::new(),
            damped,
            friction,
        })
    }

    /// The model without friction.
    pub fn ideal(&self) -> &BranchedDouble {
        &self.ideal
    }

    /// Returns the model with friction; `None` if friction is zero.
    pub fn damped(&self) -> Option<&DampedBranchedDouble> {
        self.damped.as_ref()
    }

    /// Computes all quantities at a state (θ_1, θ_m, θ_d and their rates).
    pub fn measure(&self, time: f64, coordinates: [f64; 3], rates: [f64; 3]) -> Sample {
        let theta = self.ideal.from_symmetric(&coordinates);
        let omega = self.ideal.from_symmetric(&rates);
        let momenta = self.ideal.symmetric_momenta(&coordinates, &rates);
        Sample {
            time,
            theta,
            omega,
            coordinates,
            rates,
            momenta,
            antiphase_energy: self.ideal.antiphase_energy(&coordinates, &momenta),
            energy: self.ideal.kinetic_energy(&theta, &omega) + self.ideal.potential_energy(&theta),
            flow: self.flow(&coordinates, &rates),
        }
    }

    /// H_d at a state.
    pub fn antiphase_energy(&self, coordinates: &[f64; 3], rates: &[f64; 3]) -> f64 {
        let momenta = self.ideal.symmetric_momenta(coordinates, rates);
        self.ideal.antiphase_energy(coordinates, &momenta)
    }

    /// Computes W and the power of friction at a state.
    pub fn flow(&self, coordinates: &[f64; 3], rates: &[f64; 3]) -> Flow {
        let momenta = self.ideal.symmetric_momenta(coordinates, rates);
        let [omega_1, omega_m, omega_d] = *rates;
        // (ω_2 − ω_1)² + (ω_3 − ω_1)² = 2 (ω_m − ω_1)² + 2 ω_d²
        let children = 2.0 * ((omega_m - omega_1).powi(2) + omega_d.powi(2));
        Flow {
            transfer: [
                self.ideal.transfer_angle_1(coordinates, &momenta),
                self.ideal.transfer_amplitude_2(coordinates, &momenta),
                self.ideal.transfer_exact_from_rates(coordinates, rates),
            ],
            antiphase_friction: self.damped.map_or(0.0, |damped| {
                damped.antiphase_friction_power_from_rates(coordinates, rates)
            }),
            // A difference, because minus zero would show in tables.
            friction: 0.0
                - self.friction.root * omega_1.powi(2)
                - self.friction.children * children,
        }
    }
}

impl Flow {
    /// Adds `weight` times `other`, as a step of numerical integration over time.
    pub fn add(&mut self, weight: f64, other: &Self) {
        for (sum, transfer) in self.transfer.iter_mut().zip(other.transfer) {
            sum.kinetic += weight * transfer.kinetic;
            sum.potential += weight * transfer.potential;
        }
        self.antiphase_friction += weight * other.antiphase_friction;
        self.friction += weight * other.friction;
    }

    /// Returns dH_d/dt according to the form of W with this index.
    pub fn antiphase_rate(&self, form: usize) -> f64 {
        self.transfer
            .get(form)
            .map_or(f64::NAN, |transfer| transfer.total())
            + self.antiphase_friction
    }
}

#[cfg(test)]
mod tests {
    use super::{Apparatus, EXACT, Friction};
    use branched_pendulum_frame::command_line::plain;

    const COORDINATES: [f64; 3] = [0.7, -0.4, 0.3];
    const RATES: [f64; 3] = [1.2, -2.1, 0.9];

    /// Returns the derivative of `f` along the motion, as a central difference.
    fn rate_along_the_motion(
        accelerations: [f64; 3],
        f: impl Fn(&[f64; 3], &[f64; 3]) -> f64,
    ) -> f64 {
        let at = |step: f64| {
            let coordinates = std::array::from_fn(|i| {
                COORDINATES[i] + step * (RATES[i] + 0.5 * step * accelerations[i])
            });
            let rates = std::array::from_fn(|i| RATES[i] + step * accelerations[i]);
            f(&coordinates, &rates)
        };
        let h = 1e-4;
        (at(h) - at(-h)) / (2.0 * h)
    }

    #[test]
    fn friction_power_and_exact_transfer_are_the_rates_of_the_energies() {
        for friction in [
            Friction::default(),
            Friction {
                root: 3e-3,
                children: 5e-3,
            },
        ] {
            let apparatus = Apparatus::new(friction).unwrap();
            let accelerations = match apparatus.damped() {
                Some(damped) => damped.symmetric_accelerations(&COORDINATES, &RATES),
                None => apparatus
                    .ideal()
                    .symmetric_accelerations(&COORDINATES, &RATES),
            };
            let sample = apparatus.measure(0.0, COORDINATES, RATES);
            let energy =
                rate_along_the_motion(accelerations, |q, v| apparatus.measure(0.0, *q, *v).energy);
            let antiphase =
                rate_along_the_motion(accelerations, |q, v| apparatus.antiphase_energy(q, v));
            assert!((sample.flow.friction - energy).abs() < 1e-6);
            assert!((sample.flow.antiphase_rate(EXACT) - antiphase).abs() < 1e-6);
            assert_eq!(friction.is_zero(), energy.abs() < 1e-6);
        }
    }

    #[test]
    fn numbers_are_written_as_one_writes_them() {
        assert_eq!(plain(3e-5), "3e-5");
        assert_eq!(plain(0.01), "0.01");
        assert_eq!(plain(0.0), "0");
        let friction = Friction {
            root: 0.0,
            children: 3.5e-5,
        };
        assert_eq!(
            friction.to_string(),
            "friction 0 (root), 3.5e-5 (children) N·m·s"
        );
        assert_eq!(Friction::default().to_string(), "no friction");
    }

    #[test]
    fn impossible_friction_is_refused() {
        let error = Apparatus::new(Friction {
            root: 0.0,
            children: -1e-5,
        })
        .unwrap_err();
        assert!(error.to_string().contains("child"), "{error}");
        assert_eq!(error.value, -1e-5);
    }
}
