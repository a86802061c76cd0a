//! Forms in which functions come: by state, definition, point, cause and truncation.

use super::Argument;
use crate::named_members::named_members;

/// Form of the state that an entry point receives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryState {
    /// Absolute angles and angular velocities.
    Absolute,
    /// Symmetric coordinates and their velocities.
    Rates,
    /// Symmetric coordinates and their momenta; where differences are small,
    /// the momenta are or are not.
    Momenta(Counting),
}

/// Without a truncation nothing is counted.
pub(crate) const CANONICAL: EntryState = EntryState::Momenta(Counting::Amplitude);

impl EntryState {
    /// The arguments that hold it.
    pub fn arguments(self) -> [Argument; 2] {
        match self {
            Self::Absolute => [Argument::Theta, Argument::Omega],
            Self::Rates => [Argument::Coordinates, Argument::Rates],
            Self::Momenta(_) => [Argument::Coordinates, Argument::Momenta],
        }
    }

    /// Beginning of the names of functions of sectors.
    pub(super) fn prefix(self) -> &'static str {
        match self {
            Self::Absolute => "",
            Self::Rates | Self::Momenta(_) => "symmetric_",
        }
    }

    /// End of the names of functions of H_d and W, which are canonical by themselves.
    pub(super) fn source(self) -> &'static str {
        match self {
            Self::Momenta(_) => "",
            Self::Absolute | Self::Rates => "_from_rates",
        }
    }
}

named_members! {
    /// Definition of the kinetic energy of a sector (physics §5).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum EnergyDefinition {
        /// A0: ½ pᵀ B(0)⁻¹ p.
        Rest = "rest",
        /// A1: ½ pᵀ B(θ)⁻¹ p.
        Canonical = "canonical",
        /// B: Parseval for the velocities.
        Parseval = "parseval",
        /// C: ½ ωᵀ B(θ) ω.
        Velocity = "velocity",
    }
}

named_members! {
    /// A kind of points that all links have.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PointKind {
        /// The pivot.
        Pivot = "pivot",
        /// The centre of mass.
        Centre = "centre",
        /// The end.
        End = "end",
    }
}

named_members! {
    /// Cause of an energy transfer between copies that differ.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Cause {
        /// The tree of equal copies that have the means of all constants.
        MeanTree = "growth",
        /// Values in which the copies differ.
        Mismatch = "forcing",
    }
}

named_members! {
    /// Quantities that count as small when W is truncated.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Counting {
        /// The difference angles; momenta stay whole (the paper's sense).
        Angle = "angle",
        /// Difference angles and their momenta alike, as in an oscillation.
        Amplitude = "amplitude",
    }
}

impl Counting {
    /// Order of W that a Poisson bracket gives; others come from the velocities' series.
    pub fn bracket_order(self) -> u32 {
        match self {
            Self::Angle => 1,
            Self::Amplitude => 2,
        }
    }
}
