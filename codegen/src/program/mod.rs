//! The flat program that code is written from.
//!
//! A [`Program`] is one list of definitions in which every value uses only
//! earlier ones; entry points name their outputs in it. Equal operations on
//! equal operands are one value. Constants of the model are a second, smaller
//! list of the same kind ([`Setup`]), evaluated once.

mod angles;
mod builder;
mod choice;
pub(crate) mod constant_names;
mod constants;
mod count;
mod dead;
mod drive;
mod entries;
mod entry_state;
mod factors;
mod fuse;
mod interpret;
mod link;
mod live;
mod lower;
mod named;
mod nested_observables;
mod observables;
mod pair;
mod passes;
mod rebuild;
mod rotations;
mod rules;
mod scale;
mod sectors;
mod solve;
mod symmetric;
mod taylor;
mod terms;
mod text;
mod verify;

pub use choice::{Choice, cost};
pub use constants::{ConstantId, ConstantOp, Setup};
pub use count::Operations;
pub use fuse::FusedSum;
pub use link::{Column, Strip, Strips};
use passes::PASSES;
pub use passes::{Pass, worth};
pub use rebuild::Rebuilt;
pub use taylor::TaylorOutputs;
pub use verify::Fault;

use crate::exact::Rational;
use crate::mechanics::{Counting, Mechanics};
use crate::scene::Scene;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Lowers everything that the scene asks for into one program.
///
/// Linear in the size of the mechanics, times a logarithm.
pub fn lower(scene: &Scene, mechanics: &Mechanics) -> Program {
    lower_without(None, scene, mechanics)
}

/// Lowers what [`lower_without`] lowers, unless that is too long.
///
/// # Errors
/// [`TooManyValues`] where there would be more than [`MOST_VALUES`].
pub fn lower_in_limits(
    off: Option<Pass>,
    scene: &Scene,
    mechanics: &Mechanics,
) -> Result<Program, TooManyValues> {
    let lowered = AssertUnwindSafe(|| lower_without(off, scene, mechanics));
    catch_unwind(lowered).map_err(|reason| match reason.downcast() {
        Ok(limit) => *limit,
        Err(panic) => resume_unwind(panic),
    })
}

/// Lowers without one of the passes, to see the worth of that one. Unwinds with
/// [`TooManyValues`] where there would be more than [`MOST_VALUES`].
pub fn lower_without(off: Option<Pass>, scene: &Scene, mechanics: &Mechanics) -> Program {
    let mut lowering = lower::Lowering::new(mechanics);
    lowering.builder.off = off;
    let (entries, choice, strips) = match scene.in_loops() {
        true => entries::link_entries(scene, &mut lowering),
        false => entries::entries(scene, &mut lowering),
    };
    let mut program = lowering.builder.finish(entries, choice);
    program.strips = strips;
    PASSES
        .iter()
        .filter(|(pass, _)| off != Some(*pass))
        .fold(program, |program, (_, pass)| {
            debug_assert_eq!(program.verify(), Ok(()), "before a pass");
            let program = pass(program);
            debug_assert_eq!(program.verify(), Ok(()), "after a pass");
            program
        })
}

/// Index of a value in [`Program::definitions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ValueId(pub u32);

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
    /// Angles or angular velocities, absolute: the transform serves both.
    Absolute,
    /// Angles or angular velocities, symmetric.
    Symmetric,
    /// Constants of one link of a tree in loops.
    Constants,
    /// Its motion: sine, cosine, angular velocity, joint angle, joint rate.
    Motion,
    /// What a subtree answers: deficit xx, xy, yy of the articulated inertia, bias
    /// force, torque of its joint on the parent.
    Response,
    /// What all subtrees on a link answer.
    Sums,
    /// Kept of a link for the way down: gain and offset of its acceleration.
    Elimination,
    /// Handed down by a link: the apparent gravity at its children's pivot; with
    /// several places that at its own, and the acceleration at distance 1.
    Carried,
    /// Apparent gravity at a link's pivot.
    Pivot,
}

/// One operation. Operands are earlier values.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Op {
    /// An element of an argument.
    Input(Argument, usize),
    /// A constant of the model.
    Constant(ConstantId),
    /// A number known when the code is written.
    Number(Rational),
    /// Sine; its partner `Cos` of the same value is computed with it.
    Sin(ValueId),
    /// Cosine.
    Cos(ValueId),
    /// Square root.
    Sqrt(ValueId),
    /// Opposite.
    Neg(ValueId),
    /// Sum.
    Add(ValueId, ValueId),
    /// Difference.
    Sub(ValueId, ValueId),
    /// Product.
    Mul(ValueId, ValueId),
    /// Quotient.
    Div(ValueId, ValueId),
}

impl Op {
    /// The operands, none to two.
    pub fn operands(&self) -> impl Iterator<Item = ValueId> {
        let (first, second) = match *self {
            Self::Input(..) | Self::Constant(_) | Self::Number(_) => (None, None),
            Self::Sin(a) | Self::Cos(a) | Self::Sqrt(a) | Self::Neg(a) => (Some(a), None),
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) => {
                (Some(a), Some(b))
            }
        };
        first.into_iter().chain(second)
    }

    /// This operation on other operands.
    pub(crate) fn with_operands(&self, of: impl Fn(ValueId) -> ValueId) -> Self {
        match *self {
            Self::Input(..) | Self::Constant(_) | Self::Number(_) => self.clone(),
            Self::Sin(a) => Self::Sin(of(a)),
            Self::Cos(a) => Self::Cos(of(a)),
            Self::Sqrt(a) => Self::Sqrt(of(a)),
            Self::Neg(a) => Self::Neg(of(a)),
            Self::Add(a, b) => Self::Add(of(a), of(b)),
            Self::Sub(a, b) => Self::Sub(of(a), of(b)),
            Self::Mul(a, b) => Self::Mul(of(a), of(b)),
            Self::Div(a, b) => Self::Div(of(a), of(b)),
        }
    }
}

/// A value: how it is formed, and its name if it means something by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The operation.
    pub op: Op,
    /// Name in emitted code; unnamed values are written in place.
    pub name: Option<String>,
    /// Name for it where code needs one, if one is known.
    pub hint: Option<String>,
}

/// The shape in which an entry point returns its outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// An array.
    Vector,
    /// Two arrays of equal length.
    Pair,
    /// A square matrix of that size, by rows.
    Matrix(usize),
    /// A `Transfer`: kinetic part, potential part.
    Transfer,
    /// A number of `Transfer`s.
    Transfers(usize),
    /// That many numbers (one alone is no array), and an array of the others.
    Split(usize),
    /// A `Budget` of that many sectors: energies, transfers, powers.
    Budget(usize),
}

/// Definition of the kinetic energy of a sector (physics §5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyDefinition {
    /// A0: ½ pᵀ B(0)⁻¹ p.
    Rest,
    /// A1: ½ pᵀ B(θ)⁻¹ p.
    Canonical,
    /// B: Parseval for the velocities.
    Parseval,
    /// C: ½ ωᵀ B(θ) ω.
    Velocity,
}

/// Purpose of an entry point; the emitter documents it accordingly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// θ̈ from θ, ω.
    Accelerations,
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
    /// W to another order: the transfer, and the form in its list.
    HigherTransfer(usize, usize),
    /// The coefficients of that quadratic form.
    QuadraticForm(usize),
    /// W exactly, from coordinates and momenta.
    ExactTransfer(usize),
    /// W exactly, from coordinates and velocities.
    ExactTransferFromRates(usize),
    /// Power of friction on H_d.
    FrictionPower(usize),
    /// Energies of all sectors, the transfers into them and the power of other
    /// forces.
    Budget(EnergyDefinition),
    /// W of all sectors by parts: exact, or through an order.
    SectorTransfers(Option<(Counting, u32)>),
    /// {E_s, E_r} of the sectors by Parseval.
    TransferMatrix,
    /// Power of the drive on H_d.
    AntiphaseDrivePower(usize),
    /// The drive itself: acceleration of the root's pivot, torque on the root.
    Drive,
    /// Power of the drive on the whole tree.
    DrivePower,
    /// Power of friction and drag on the whole tree.
    TotalFrictionPower,
    /// The observable with that number.
    Observable(usize, ObservableForm),
    /// A function of the recursion, for one link of a tree in loops.
    Link(LinkFunction),
    /// Apparent gravity at the root's pivot of a tree in loops, in reduced units.
    RootGravity,
    /// What the drive adds to that, and its torque on the root, in reduced units.
    RootDrive,
}

/// The functions that the recursion calls for each link of a tree in loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkFunction {
    /// The response of a link without children.
    Leaf,
    /// The response of a child about its parent's pivot.
    Attach,
    /// The response and the elimination of a link with children.
    Inner,
    /// The apparent gravity at a child's pivot.
    Pivot,
    /// The acceleration of a link with children, and what it hands down.
    Accelerate,
    /// The acceleration of a link without children.
    AccelerateLeaf,
}

impl LinkFunction {
    /// All of them, in the order of their entry points.
    pub const ALL: [Self; 6] = [
        Self::Leaf,
        Self::Attach,
        Self::Inner,
        Self::Pivot,
        Self::Accelerate,
        Self::AccelerateLeaf,
    ];

    /// Its name in code.
    pub fn name(self) -> &'static str {
        match self {
            Self::Leaf => "leaf",
            Self::Attach => "attach",
            Self::Inner => "inner",
            Self::Pivot => "pivot",
            Self::Accelerate => "accelerate",
            Self::AccelerateLeaf => "accelerate_leaf",
        }
    }
}

/// Quantity that a function gives of an observable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObservableForm {
    /// F from coordinates and velocities.
    Value,
    /// dF/dt from coordinates and velocities.
    Rate,
    /// The part of dF/dt that is friction and drag.
    FrictionRate,
    /// F from coordinates and momenta.
    FromMomenta,
    /// dF/dt from coordinates and momenta.
    RateFromMomenta,
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
    pub shape: Shape,
}

/// All of a scene's code in one list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// Values; each uses earlier ones only.
    pub definitions: Vec<Definition>,
    /// Entry points in the order in which they are emitted.
    pub entries: Vec<Entry>,
    /// The model's constants.
    pub setup: Setup,
    /// The solve for the accelerations, and its cost.
    pub choice: Choice,
    /// The constants by strip, where the code is loops.
    pub strips: Option<Strips>,
    /// The pass that was left out, for comparison.
    pub without: Option<Pass>,
}

/// Reason for which a program could not be written.
#[derive(Clone, Copy, Debug)]
pub struct TooManyValues;

/// Most values of a program before its passes: twice as many as all exact forms of the
/// budget of 31 links have.
pub const MOST_VALUES: usize = 120_000;

impl Program {
    /// The definition of a value.
    pub fn definition(&self, id: ValueId) -> &Definition {
        &self.definitions[id.0 as usize]
    }

    /// The entry point of that name.
    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }
}
