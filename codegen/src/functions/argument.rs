//! Arguments and results of generated functions.

/// An argument of an entry point: an array, except the time, which is a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Argument {
    /// Time, in s: a single number.
    Time,
    /// Absolute angles, in rad.
    Theta,
    /// Angular velocities, in rad/s.
    Omega,
    /// Canonical momenta of the absolute angles, in kg m²/s.
    AbsoluteMomenta,
    /// Symmetric coordinates (means and differences of copies), in rad.
    Coordinates,
    /// Velocities of the symmetric coordinates, in rad/s.
    Rates,
    /// Canonical momenta of the symmetric coordinates, in kg m²/s.
    Momenta,
    /// Forces on the links, x and y of each, in N.
    Forces,
    /// Angular accelerations, in rad/s².
    Alpha,
    /// Small differences of the transverse sector with this index, in rad.
    Difference(usize),
    /// Rates of those small differences, in rad/s.
    DifferenceRate(usize),
    /// Small differences of all sectors that act back on the motion, one sector after the other, in
    /// rad.
    SmallDifferences,
    /// Rates of the small differences that act back, in rad/s.
    SmallRates,
    /// Actions of the in-phase modes, in J s.
    Actions,
    /// External generalized torques, one per absolute angle, in N m.
    Torques,
    /// External generalized torques on the small differences that act back, in N m.
    SmallTorques,
    /// Weights of the results in the sum that a pullback differentiates.
    Weights,
    /// Accelerations of the prescribed links in the set with this index, in rad/s².
    Prescribed(usize),
    /// Absolute angles or angular velocities; both are converted to symmetric coordinates by the
    /// same map.
    Absolute,
    /// Symmetric coordinates or their velocities; both are converted to absolute ones by the same
    /// map.
    Symmetric,
    /// Constants of one link of a tree in loops, for the equations of motion.
    Constants,
    /// Constants of one link of a tree in loops, for energies and powers.
    Body,
    /// Motion of one link: sine and cosine of the angle, angular velocity, joint angle, joint rate,
    /// external torque.
    Motion,
    /// Response of a subtree to the acceleration of its pivot: components xx, xy, yy of the
    /// difference between its mass and its articulated inertia, bias force, and torque of its joint
    /// on the parent.
    Response,
    /// Sum of the responses of all subtrees on a link.
    Sums,
    /// Gain and offset of a link's acceleration, stored for the downward pass.
    Elimination,
    /// Values that a link passes on in the downward pass: the apparent gravity at its children's
    /// pivot. If children hang at several points, the apparent gravity at its own pivot, and the
    /// acceleration at distance 1.
    Carried,
    /// Apparent gravity at a link's pivot.
    Pivot,
    /// Numbers with these names, which a function of one link takes in addition to constants and
    /// motion.
    Given(&'static [&'static str]),
}

/// Type in which an entry point returns its outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultShape {
    /// One number.
    Scalar,
    /// An array.
    Vector,
    /// Number of arrays, and their length.
    Rows(usize, usize),
    /// A `Transfer`: kinetic and potential part.
    Transfer,
    /// Array of this many `Transfer`s.
    Transfers(usize),
    /// At most four arrays of these lengths.
    Arrays([Option<usize>; 4]),
    /// This many numbers (a single one is not an array), and an array of the remaining outputs.
    Split(usize),
    /// A `Budget` of this many sectors: energies, transfers, powers.
    Budget(usize),
}

impl Argument {
    /// Returns the name of the argument in emitted code.
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
            Self::Actions => "actions",
            Self::Difference(_) | Self::SmallDifferences => "difference",
            Self::DifferenceRate(_) | Self::SmallRates => "difference_rate",
            Self::Torques => "torques",
            Self::SmallTorques => "difference_torques",
            Self::Weights => "weights",
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
