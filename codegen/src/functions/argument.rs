//! Arguments and results of functions.

/// An argument of an entry point: an array, but for the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Argument {
    /// Time, s: a single number.
    Time,
    /// Absolute angles, rad.
    Theta,
    /// Angular velocities, rad/s.
    Omega,
    /// Momenta that belong to the absolute angles, kg m²/s.
    AbsoluteMomenta,
    /// Symmetric coordinates, rad.
    Coordinates,
    /// Their velocities, rad/s.
    Rates,
    /// Momenta that belong to the symmetric coordinates, kg m²/s.
    Momenta,
    /// Forces on the links, x and y of each, N.
    Forces,
    /// Angular accelerations, rad/s².
    Alpha,
    /// Small differences in the transverse sector with that number, rad.
    Difference(usize),
    /// Their rates, rad/s.
    DifferenceRate(usize),
    /// Differences in all sectors that act back, one sector after the other, rad.
    SmallDifferences,
    /// Their rates, rad/s.
    SmallRates,
    /// Generalized torques from outside, one for each absolute angle, N m.
    Torques,
    /// Generalized torques from outside on the differences that act back, N m.
    SmallTorques,
    /// Accelerations of the prescribed links of the set with that number, rad/s².
    Prescribed(usize),
    /// Angles or angular velocities, absolute: the transform serves both.
    Absolute,
    /// Angles or angular velocities, symmetric.
    Symmetric,
    /// Constants of one link of a tree in loops.
    Constants,
    /// Constants of one link as a body, which energies and powers read.
    Body,
    /// The link's motion: sine, cosine, angular velocity, joint angle, joint rate, torque from
    /// outside.
    Motion,
    /// Response of a subtree: deficit xx, xy, yy of the articulated inertia, bias
    /// force, torque of its joint on the parent.
    Response,
    /// Sum of the responses of all subtrees on a link.
    Sums,
    /// Kept of a link for the way down: gain and offset of its acceleration.
    Elimination,
    /// Handed down by a link: the apparent gravity at its children's pivot; with
    /// several places that at its own, and the acceleration at distance 1.
    Carried,
    /// Apparent gravity at a link's pivot.
    Pivot,
    /// Numbers of these names, which a function of one link takes beside constants and motion.
    Given(&'static [&'static str]),
}

/// The shape in which an entry point returns its outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultShape {
    /// One number.
    Scalar,
    /// An array.
    Vector,
    /// So many arrays of the other length.
    Rows(usize, usize),
    /// A `Transfer`: kinetic part, potential part.
    Transfer,
    /// A number of `Transfer`s.
    Transfers(usize),
    /// Two arrays of these lengths.
    Arrays(usize, usize),
    /// So many numbers (one alone is no array), and an array of the others.
    Split(usize),
    /// A `Budget` of that many sectors: energies, transfers, powers.
    Budget(usize),
}

impl Argument {
    /// Name of the argument in emitted code.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Theta => "theta",
            Self::Omega => "omega",
            Self::AbsoluteMomenta | Self::Momenta => "momenta",
            Self::Coordinates => "coordinates",
            Self::Rates => "rates",
            Self::Forces => "forces",
            Self::Alpha => "alpha",
            Self::Difference(_) | Self::SmallDifferences => "difference",
            Self::DifferenceRate(_) | Self::SmallRates => "difference_rate",
            Self::Torques => "torques",
            Self::SmallTorques => "difference_torques",
            Self::Prescribed(_) => "prescribed",
            Self::Absolute => "absolute",
            Self::Symmetric => "symmetric",
            Self::Constants => "constants",
            Self::Body => "body",
            Self::Motion => "link",
            Self::Response => "response",
            Self::Sums => "below",
            Self::Elimination => "elimination",
            Self::Carried => "carried",
            Self::Pivot => "pivot",
            Self::Given(_) => "given",
        }
    }
}
