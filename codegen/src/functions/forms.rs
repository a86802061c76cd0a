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

named_members! {
    /// Quantity that a function gives of an observable. Names are ends of the names of
    /// functions.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ObservableForm {
        /// F from coordinates and velocities.
        Value = "",
        /// dF/dt from coordinates and velocities.
        Rate = "_rate",
        /// The part of dF/dt that is friction and drag.
        FrictionRate = "_friction_rate",
        /// F from coordinates and momenta.
        FromMomenta = "_from_momenta",
        /// dF/dt from coordinates and momenta.
        RateFromMomenta = "_rate_from_momenta",
    }
}

impl ObservableForm {
    /// Returns true if it is a rate by all forces.
    pub fn is_rate(self) -> bool {
        matches!(self, Self::Rate | Self::RateFromMomenta)
    }

    /// Returns true if momenta are handed over.
    pub fn is_from_momenta(self) -> bool {
        matches!(self, Self::FromMomenta | Self::RateFromMomenta)
    }
}

/// Meaning of the properties of a link, in the order in which a model hands them over.
pub const LINK_PROPERTIES: [&str; 8] = [
    "mass (kg)",
    "moment of inertia about the centre of mass (kg m²)",
    "place of the centre of mass along the link, from its pivot (m)",
    "place of the centre of mass across the link (m)",
    "place of the pivot along the parent, from the parent's pivot (m)",
    "place of the pivot across the parent (m)",
    "place of the end along the link, from its pivot (m)",
    "place of the end across the link (m)",
];
