//! Entry points: purpose, arguments and shape of the functions that code has.

use super::{ScaleFunction, ValueId};
use crate::mechanics::Counting;
use crate::named_members::named_members;
use crate::scene::ObservableForm;

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
    /// Its motion: sine, cosine, angular velocity, joint angle, joint rate, torque from
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
    /// Numbers that a function of energies by scale takes beside constants and motion.
    Given(ScaleFunction),
}

/// The shape in which an entry point returns its outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultShape {
    /// One number.
    Scalar,
    /// An array.
    Vector,
    /// That many arrays of the other length.
    Rows(usize, usize),
    /// A `Transfer`: kinetic part, potential part.
    Transfer,
    /// A number of `Transfer`s.
    Transfers(usize),
    /// Two arrays of these lengths.
    Arrays(usize, usize),
    /// That many numbers (one alone is no array), and an array of the others.
    Split(usize),
    /// A `Budget` of that many sectors: energies, transfers, powers.
    Budget(usize),
}

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
pub(super) const CANONICAL: EntryState = EntryState::Momenta(Counting::Amplitude);

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

    /// End of the names of transfers, which are canonical by themselves.
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

/// Purpose of an entry point; the emitter documents it accordingly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// θ̈ from θ, ω.
    Accelerations,
    /// θ̈ from θ, ω and torques from outside.
    AccelerationsUnder,
    /// θ̈ and the reactions of prescribed links, from θ, ω, torques from outside and the
    /// accelerations of the prescribed links of the set with that number.
    Prescribed(usize),
    /// The coefficients of θ and ω in powers of the time: order 0 of the
    /// recurrences, which is θ̈ and the sines and cosines that it goes without.
    TaylorCoefficients,
    /// K.
    KineticEnergy,
    /// U.
    PotentialEnergy,
    /// p from θ, ω.
    AbsoluteMomenta,
    /// ω from θ, p.
    AbsoluteVelocities,
    /// ω and ṗ from θ, p.
    CanonicalRates,
    /// M at θ.
    MassMatrix,
    /// ∂²U/∂θ∂θ at θ.
    StiffnessMatrix,
    /// Symmetric coordinates from absolute angles.
    ToSymmetric,
    /// Absolute angles from symmetric coordinates.
    FromSymmetric,
    /// q̈ from q, q̇.
    SymmetricAccelerations,
    /// p from q, q̇.
    SymmetricMomenta,
    /// q̇ from q, p.
    SymmetricVelocities,
    /// H in symmetric coordinates and momenta.
    Hamiltonian,
    /// H_d of the transfer with that number.
    SubHamiltonian(usize),
    /// W to first order in the difference angles.
    AngleTransfer(usize),
    /// W to second order in the amplitude.
    AmplitudeTransfer(usize),
    /// W through another order.
    HigherTransfer(usize, Counting, u32),
    /// The coefficients of that quadratic form.
    QuadraticForm(usize),
    /// W exactly.
    ExactTransfer(usize, EntryState),
    /// The part of W that has this cause.
    SplitTransfer(usize, Cause, EntryState),
    /// Power of friction on H_d.
    FrictionPower(usize),
    /// Energies of all sectors, the transfers into them and the power of other
    /// forces.
    Budget(EnergyDefinition, EntryState),
    /// That budget with the power of torques from outside, from absolute angles.
    BudgetUnder(EnergyDefinition),
    /// W of all sectors by parts.
    SectorTransfers(EntryState),
    /// W of all sectors by parts, through an order.
    TruncatedSectorTransfers(Counting, u32),
    /// {E_s, E_r} of the sectors by Parseval.
    TransferMatrix(EntryState),
    /// Power of the drive on H_d.
    AntiphaseDrivePower(usize),
    /// Power of torques from outside on H_d.
    AntiphaseOutsidePower(usize),
    /// The drive itself: acceleration of the root's pivot, torque on the root.
    Drive,
    /// Power of the drive on the whole tree.
    DrivePower,
    /// Power of friction and drag on the whole tree.
    TotalFrictionPower,
    /// Power of torques from outside on the whole tree.
    OutsidePower,
    /// The observable with that number.
    Observable(usize, ObservableForm),
    /// Accelerations of small differences in the transverse sector with that number.
    Transverse(usize),
    /// Their energy.
    TransverseEnergy(usize),
    /// Its rate without friction.
    TransverseTransfer(usize),
    /// The power of friction on it; true where that depends on the motion in phase.
    TransverseFriction(usize, bool),
    /// Accelerations of angles and of small differences that act back.
    SmallAccelerations,
    /// The same under torques from outside.
    SmallAccelerationsUnder,
    /// Their energy.
    SmallEnergy,
    /// Positions of these points of all links.
    Positions(PointKind),
    /// Their velocities.
    PointVelocities(PointKind),
    /// Generalized torques Q of forces there.
    PointTorques(PointKind),
    /// Masses, moments of inertia and places of the links.
    LinkProperties,
    /// A function of the recursion, for one link of a tree in loops.
    Link(LinkFunction),
    /// A function of energies by scale, for one link of a tree in loops.
    Scale(ScaleFunction),
    /// Apparent gravity at the root's pivot of a tree in loops, in reduced units.
    RootGravity,
    /// Contribution of the drive to that, and its torque on the root, in reduced units.
    RootDrive,
}

named_members! {
    /// The functions that the recursion calls for each link of a tree in loops.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LinkFunction {
        Leaf = "leaf":
            "The response of a link without children: N and γ, and the torque of its joint on the parent where joints have torques.",
        Attach = "attach":
            "The response of a child about the pivot of its parent, whose motion is given: as it is where all children share one pivot.",
        Inner = "inner":
            "The response of a link with children, and b/J and κ/J, which `accelerate` takes.",
        Pivot = "pivot":
            "The apparent gravity at a child's pivot.",
        Accelerate = "accelerate":
            "The angular acceleration (in rad/s²) of a link with children, and what it hands them.",
        AccelerateLeaf = "accelerate_leaf":
            "The angular acceleration (in rad/s²) of a link without children.",
    }
}

/// An entry point: the program pruned to its outputs becomes a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Function name.
    pub name: String,
    /// Its purpose.
    pub purpose: Purpose,
    /// Arguments in order.
    pub arguments: Vec<Argument>,
    /// Output values.
    pub outputs: Vec<ValueId>,
    /// Shape of the outputs.
    pub shape: ResultShape,
}
