//! Growth at every angle.

use std::fmt;

use branched_pendulum::analysis::growth::{Grown, Growth, frequency_at_rest};
use branched_pendulum::prelude::*;

use super::arguments::Arguments;
use super::scene::{InPhase, InPhaseParameters, at_rest, first_sector};
use branched_pendulum_frame::Failure;

/// Angles of the paper, degrees: growth is not seen at the first and is at the second.
pub const PAPER: [f64; 2] = [47.6, 47.8];

/// Angles that are computed at a time.
const BLOCK: usize = 128;

/// Friction in the children's pivots, by the quality factor of the antiphase mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// None.
    Without,
    /// With this quality factor.
    Quality(f64),
}

impl fmt::Display for Friction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Without => f.write_str("without friction"),
            Self::Quality(quality) => write!(f, "quality factor {quality}"),
        }
    }
}

impl Friction {
    /// The frictions of a command line.
    pub fn all(arguments: &Arguments) -> Vec<Self> {
        let qualities = arguments.quality.iter().rev();
        let with = qualities.map(|quality| Self::Quality(*quality));
        std::iter::once(Self::Without).chain(with).collect()
    }

    /// Returns the constant c of the pivots, N m s.
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn constant(self) -> Result<f64, Failure> {
        // A constant at which the decay is looked at; it is proportional.
        const TRIAL: f64 = 1e-5;
        let Self::Quality(quality) = self else {
            return Ok(0.0);
        };
        let model = InPhase::new(InPhaseParameters { friction: TRIAL })?;
        let ode = first_sector(&model)?;
        let mut rates = [0.0; 6];
        // The rate of the difference alone.
        ode.rates(0.0, &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0], &mut rates);
        let decay = -rates[5] / TRIAL;
        Ok(std::f64::consts::TAU * frequency_at_rest(&ode) / (quality * decay))
    }
}

/// The growth at every angle with one friction.
#[derive(Clone, Debug)]
pub struct Scan {
    /// The friction.
    pub friction: Friction,
    /// Constant of the friction, N m s.
    pub constant: f64,
    /// Angles of the scan, degrees.
    pub angles_deg: Vec<f64>,
    /// Growth at each of them.
    pub grown: Vec<Grown>,
    /// Growth at the angles of the [`PAPER`].
    pub paper: Vec<Grown>,
}

impl Scan {
    /// Computes the growth at every angle, and tells `progress` which part is done.
    ///
    /// # Errors
    /// [`Failure::Parameter`] or [`Failure::Growth`].
    pub fn new(
        arguments: &Arguments,
        friction: Friction,
        progress: impl Fn(f64),
    ) -> Result<Self, Failure> {
        let constant = friction.constant()?;
        let model = InPhase::new(InPhaseParameters { friction: constant })?;
        let angles_deg = arguments.angles_deg.clone();
        let ode = first_sector(&model)?;
        let releases = angles_deg.iter().chain(&PAPER);
        let releases: Vec<_> = releases
            .map(|degrees| (ode, at_rest(&model, *degrees, 0.0)))
            .collect();
        let growth = Growth {
            frequency_hz: frequency_at_rest(&ode),
            horizons: arguments.horizons.clone(),
            tolerance: arguments.tolerance,
        };
        let mut grown = Vec::new();
        for block in releases.chunks(BLOCK) {
            for one in growth.in_lanes(&Ensemble::new(), block) {
                grown.push(one?);
            }
            progress(grown.len() as f64 / releases.len() as f64);
        }
        let paper = grown.split_off(angles_deg.len());
        Ok(Self {
            friction,
            constant,
            angles_deg,
            grown,
            paper,
        })
    }

    /// Angles and growth of the scan.
    pub fn points(&self) -> impl Iterator<Item = (f64, &Grown)> {
        self.angles_deg.iter().copied().zip(&self.grown)
    }

    /// The angles at which some factor is not determined.
    pub fn undetermined(&self) -> impl Iterator<Item = f64> {
        let open = |grown: &Grown| !grown.factors.iter().all(|factor| factor.is_determined());
        self.points()
            .filter_map(move |(angle, grown)| open(grown).then_some(angle))
    }
}
