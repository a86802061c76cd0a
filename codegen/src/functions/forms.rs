//! Variants of functions: by state, definition of the energy, kind of point, cause and truncation.

use super::Argument;
use crate::named_members::named_members;

/// Variables of the state that an entry point receives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryState {
    /// Absolute angles and angular velocities.
    Absolute,
    /// Symmetric coordinates and their velocities.
    Rates,
    /// Symmetric coordinates and their momenta. `Counting` states whether the momenta count as
    /// small too.
    Momenta(Counting),
}

/// The canonical state; without truncation the counting has no effect.
pub(crate) const CANONICAL: EntryState = EntryState::Momenta(Counting::Amplitude);

impl EntryState {
    /// Returns the two arguments that hold the state.
    pub fn arguments(self) -> [Argument; 2] {
        match self {
            Self::Absolute => [Argument::Theta, Argument::Omega],
            Self::Rates => [Argument::Coordinates, Argument::Rates],
            Self::Momenta(_) => [Argument::Coordinates, Argument::Momenta],
        }
    }

    /// Returns the first part of the names of functions of sectors.
    pub(super) fn prefix(self) -> &'static str {
        match self {
            Self::Absolute => "",
            Self::Rates | Self::Momenta(_) => "symmetric_",
        }
    }

    /// Returns the last part of the names of functions of H_d (energy of a difference) and W
    /// (transfer into it). It is empty for the canonical state.
    pub(super) fn source(self) -> &'static str {
        match self {
            Self::Momenta(_) => "",
            Self::Absolute | Self::Rates => "_from_rates",
        }
    }
}

named_members! {
    /// Definition of the kinetic energy of a sector (physics §5); B is the sector's block of the
    /// mass matrix.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum EnergyDefinition {
        /// A0: ½ pᵀ B(0)⁻¹ p, with the block at rest.
        Rest = "rest",
        /// A1: ½ pᵀ B(θ)⁻¹ p, with the block at the current angles.
        Canonical = "canonical",
        /// B: from velocities, by Parseval's identity.
        Parseval = "parseval",
        /// C: ½ ωᵀ B(θ) ω, from velocities, with the block at the current angles.
        Velocity = "velocity",
    }
}

named_members! {
    /// A kind of point that every link has.
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
    /// Function of the resonant normal form of degree 4. The names are endings of function names.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum NormalFormFunction {
        /// Actions of a release from rest.
        Actions = "actions",
        /// Frequencies of the in-phase modes and of a difference, from the actions.
        Frequencies = "frequencies",
        /// Coupling of a difference to the in-phase motion, from the actions.
        Coupling = "coupling",
        /// Square of the growth rate of a difference, from the actions.
        Growth = "growth_rate_squared",
        /// Squares of the factors that take a release to the thresholds of growth.
        Thresholds = "thresholds",
    }
}

named_members! {
    /// Cause of an energy transfer between copies that differ.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Cause {
        /// The mean tree: equal copies with the means of all constants.
        MeanTree = "growth",
        /// The deviations of the copies' constants from their means.
        Mismatch = "forcing",
    }
}

named_members! {
    /// Quantities that count as small when the transfer W is truncated.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Counting {
        /// The difference angles alone, not their momenta (the paper's sense).
        Angle = "angle",
        /// The difference angles and their momenta, as in an oscillation.
        Amplitude = "amplitude",
    }
}

impl Counting {
    /// Returns the order of W that is a single Poisson bracket; other orders are computed from the
    /// series of the velocities.
    pub fn bracket_order(self) -> u32 {
        match self {
            Self::Angle => 1,
            Self::Amplitude => 2,
        }
    }
}

named_members! {
    /// Quantity that a function returns for an observable F. The names are endings of function
    /// names.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ObservableForm {
        /// Value of the observable F, computed from coordinates and velocities.
        Value = "",
        /// Rate of change dF/dt, computed from coordinates and velocities.
        Rate = "_rate",
        /// Part of dF/dt that friction and drag cause.
        FrictionRate = "_friction_rate",
        /// Value of the observable F, computed from coordinates and momenta.
        FromMomenta = "_from_momenta",
        /// Rate of change dF/dt, computed from coordinates and momenta.
        RateFromMomenta = "_rate_from_momenta",
    }
}

impl ObservableForm {
    /// Returns true if the function returns the rate caused by all forces.
    pub fn is_rate(self) -> bool {
        matches!(self, Self::Rate | Self::RateFromMomenta)
    }

    /// Returns true if the function takes momenta.
    pub fn is_from_momenta(self) -> bool {
        matches!(self, Self::FromMomenta | Self::RateFromMomenta)
    }
}

/// Meaning of the properties of a link, in the order in which a model returns them.
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

/// Names of the weights of the drive's components: acceleration of the root's pivot and torque on the
/// root.
pub(crate) const DRIVE_WEIGHTS: &[&str] = &["pivot_x", "pivot_y", "torque"];
