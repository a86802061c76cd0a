//! The symbolic derivation: from a scene to its mechanics.
//!
//! All formulas are derived from the positions of the links; closed forms from the literature serve
//! only as references in tests. During the derivation formulas are Symbolica's (in [`algebra`]);
//! the results are plain data.
//!
//! Symbols used throughout: K and U are the kinetic and potential energy of the tree, M its mass
//! matrix, M̃ that in symmetric coordinates, H_d = T + V the energy of one difference between
//! copies, W = {H_d, H} the power that the rest of the tree supplies to it, and R Rayleigh's
//! dissipation function.

pub mod algebra;
mod articulation;
mod body;
mod bracket;
mod chords;
mod derivation;
mod differences;
mod drive;
pub mod expression;
mod finish;
mod finish_loops;
mod force_elements;
mod frame;
mod friction;
mod hamiltonian;
mod inverse_mass;
mod joint;
mod joint_forces;
mod lagrangian;
mod laws;
mod letters;
mod line_potentials;
mod lines;
mod link;
mod link_pairs;
mod lock;
mod meaning;
mod mismatch;
mod normal_form;
mod observable;
mod observable_rate;
mod observables;
mod positions;
mod print;
mod rate_symbols;
mod scales;
pub mod sectors;
mod series;
mod show;
mod show_transverse;
mod siblings;
mod small;
mod symmetric;
mod transfer;
mod transverse;
mod work_limit;

pub use algebra::AlgebraError;
pub use articulation::{Articulation, Joint};
pub use body::{BodySymbols, LinkBody};
pub use derivation::{AngleCombination, CombinationId, Trigonometric};
pub use differences::{SmallFormulas, SmallMechanics, TransverseFormulas, TransverseMechanics};
pub use drive::{DriveTerms, PivotMotion};
pub use friction::{BrakingTorque, TorqueSource};
pub use joint_forces::{JointForces, JointSymbols};
pub use lines::LineTorque;
pub use link::{Composite, LinkBalance, LinkSymbols};
pub use link_pairs::PairElement;
pub use lock::LockError;
pub use meaning::{JointDifference, LineMeaning, Temporal};
pub use normal_form::{DefinitionKind, NormalFormDefinition, NormalFormFormulas, ResonantGrowth};
pub use observables::{
    AppliedFunction, CanonicalRate, EnergySymbols, LinearSystem, NestedSymbols, ObservableFormulas,
    ObservableFrame, Observables,
};
pub use positions::{LinkPositions, RelativePosition};
pub(crate) use print::superscript;
pub use print::{constant_latex, constant_text, latex, text};
pub use scales::{LinkScales, ScaleSymbols};
pub use sectors::{OrbitChord, OrbitConstants, OrbitCoupling, OrbitMechanics};
pub use work_limit::MOST_TERMS;

use crate::functions::Counting;
use crate::scene::{Coordinate, Scene};
use derivation::Derivation;
use expression::{Expr, SymbolId, Symbols};
use std::collections::BTreeMap;

/// A constant of the model: a combination of masses, lengths and gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Symbol of the constant.
    pub symbol: SymbolId,
    /// Value in terms of the scene's parameters.
    pub value: Expr,
    /// Meaning in words.
    pub meaning: String,
    /// Unit of the value.
    pub unit: &'static str,
}

/// One entry of the lower triangle of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixEntry {
    /// Row index, at least `column`.
    pub row: usize,
    /// Column index.
    pub column: usize,
    /// Value, never zero.
    pub value: Expr,
}

/// Kinetic and potential part of an energy. For the transfer W into the energy H_d = T + V of a
/// difference, the parts are {H_d, K − T} and {H_d, U − V}, the contributions of the rest of the
/// tree's kinetic and potential energy.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyParts<F = Expr> {
    /// Kinetic part of the energy.
    pub kinetic: F,
    /// Potential part of the energy.
    pub potential: F,
}

impl<F> EnergyParts<F> {
    fn map<G>(&self, formed: impl Fn(&F) -> G) -> EnergyParts<G> {
        EnergyParts {
            kinetic: formed(&self.kinetic),
            potential: formed(&self.potential),
        }
    }
}

/// The Lagrangian in one set of generalized coordinates, with the quantities derived from it. The
/// equations of motion are Σ_j M_ij q̈_j + bias_i = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Generalized coordinates.
    pub coordinates: Vec<SymbolId>,
    /// Generalized velocities.
    pub velocities: Vec<SymbolId>,
    /// Generalized momenta.
    pub momenta: Vec<SymbolId>,
    /// Mass matrix, lower triangle without zeros, by row.
    pub mass: Vec<MatrixEntry>,
    /// Second derivatives of the potential energy, in the same layout, if modes are requested.
    pub stiffness: Option<Vec<MatrixEntry>>,
    /// Kinetic energy in coordinates and velocities, and potential energy, which is zero if all
    /// coordinates are zero; if energies are requested.
    pub energies: Option<EnergyParts>,
    /// Momenta p_i = ∂L/∂v_i in coordinates and velocities, if momenta are requested.
    pub momentum: Option<Vec<Expr>>,
    /// Rates ṗ_i = ∂L/∂q_i + Q_i in coordinates and velocities, including friction, drag and drive;
    /// if momenta are requested.
    pub momentum_rates: Option<Vec<Expr>>,
    /// Torques of friction that is not viscous, which have their own symbols.
    pub torques: Vec<BrakingTorque>,
    /// Generalized forces −∂R/∂v_i of friction and drag, zero without them; `bias` contains them
    /// with the opposite sign.
    pub dissipative_forces: Vec<Expr>,
    /// Generalized forces Q_i(t, q) of the drive, zero without one; `bias` contains them with the
    /// opposite sign.
    pub drive: Vec<Expr>,
    /// Centrifugal, gravity, friction and drive terms of the Euler–Lagrange equations.
    pub bias: Vec<Expr>,
}

/// Energy H_d of one difference and the transfer W into it. The formulas use symmetric coordinates
/// and their momenta, with in-phase velocities w in the truncated forms and generalized velocities
/// in the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFormulas {
    /// Index of the difference among the symmetric coordinates.
    pub coordinate: usize,
    /// Kinetic and potential part of H_d.
    pub energy: EnergyParts,
    /// W truncated at the requested orders: first order in the difference angles (the paper's W_K,
    /// W_P), second order in the amplitude, then others.
    pub truncated: Vec<Truncated>,
    /// Coefficients of p_d², p_d θ_d, θ_d² in W to second order in the amplitude, if W is a
    /// quadratic form in this difference alone.
    pub quadratic_form: Option<[Expr; 3]>,
    /// Exact W, split by the energy that it comes from.
    pub exact: Option<EnergyParts>,
    /// Exact W between copies that differ, split into the contribution of the mean tree, in its
    /// velocities, and that of the mismatches.
    pub split: Option<[EnergyParts; 2]>,
    /// Power of friction and drag on H_d; zero without both.
    pub friction: Expr,
    /// Power of the drive on H_d; zero if the pivot is fixed.
    pub drive: Expr,
    /// Velocity ∂H_d/∂p_d, which a torque on the difference multiplies to give its power.
    pub velocity: Expr,
}

impl TransferFormulas {
    /// Returns W truncated at the given order, if it is requested.
    pub fn truncated(&self, counting: Counting, order: u32) -> Option<&EnergyParts> {
        let mut all = self.truncated.iter();
        let found = all.find(|form| (form.counting, form.order) == (counting, order));
        found.map(|form| &form.parts)
    }
}

/// W truncated at an order.
#[derive(Clone, Debug, PartialEq)]
pub struct Truncated {
    /// Quantities that count as small: angles alone, or angles and momenta.
    pub counting: Counting,
    /// Highest order that is kept.
    pub order: u32,
    /// Kinetic and potential part of the truncated W, expressed in the symbols of the expansion
    /// (see [`Correction`]).
    pub parts: EnergyParts,
}

/// Terms of one order in the series of the velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction<F = Expr> {
    /// In-phase velocities x, in the order of the means; empty if all vanish.
    pub in_phase: Vec<SymbolId>,
    /// Right side of the linear system M⁽⁰⁾ x = right that defines them.
    pub right: Vec<F>,
    /// Velocities of the differences, with their values.
    pub differences: Vec<(SymbolId, F)>,
}

/// Inverse mass matrix, expanded about the in-phase motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MassExpansion {
    /// Indices of the in-phase coordinates (means).
    pub in_phase: Vec<usize>,
    /// Symbols of w = M⁽⁰⁾⁻¹ p for the in-phase coordinates.
    pub velocities: Vec<SymbolId>,
    /// In-phase block of M⁽⁰⁾; row and column indices refer to `in_phase`.
    pub leading: Vec<MatrixEntry>,
    /// Velocities of higher orders; each order uses earlier ones.
    pub corrections: Vec<Correction>,
    /// w and the inverse mass matrix, solved and written out, for small blocks.
    pub written_out: Option<WrittenOut>,
}

/// The mean tree: the tree in which copies that differ have their mean constants.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanTree {
    /// Mechanics of the mean tree, in the symmetric coordinates of the tree.
    pub frame: Frame,
    /// Velocities that the mismatches add at given momenta; the system has the mass matrix of the
    /// mean tree.
    pub added: LinearSystem,
}

/// Formulas for printing: solutions of linear systems, written out.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenOut {
    /// Symbol D of the determinant.
    pub determinant: SymbolId,
    /// Determinant D of the in-phase block.
    pub determinant_value: Expr,
    /// Velocities w, one per in-phase coordinate.
    pub velocities: Vec<Expr>,
    /// Inverse M̃⁻¹ at the in-phase motion, dense.
    pub inverse: Vec<Vec<Expr>>,
    /// First-order correction of M̃⁻¹ in the difference angles, dense.
    pub inverse_first_order: Vec<Vec<Expr>>,
}

/// All results of the derivation for a scene. Invariants: mass matrices are symmetric and zero
/// between unrelated branches; K = ½ vᵀ M v.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanics {
    /// All symbols.
    pub symbols: Symbols,
    /// Symbols of the scene's parameters, in the scene's order.
    pub parameters: Vec<SymbolId>,
    /// Definitions of the relative angles and rates of joints.
    pub joints: BTreeMap<SymbolId, JointDifference>,
    /// Definitions of the symbols of straight springs' lines.
    pub lines: BTreeMap<SymbolId, LineMeaning>,
    /// Definition of every trigonometric symbol.
    pub trigonometry: BTreeMap<SymbolId, Trigonometric>,
    /// Combinations of differences whose sine and versine are used.
    pub combinations: Vec<AngleCombination>,
    /// Constants of the model, in the order of their symbols.
    pub constants: Vec<Constant>,
    /// The drive, if the scene has one.
    pub drive: Option<DriveTerms>,
    /// Power −2 R of friction and drag, with Rayleigh's function R. Present if energies are
    /// requested and a drive or external torques feed them; `None` for trees in loops.
    pub friction_power: Option<Expr>,
    /// Mechanics in absolute angles; without coordinates if the code is loops.
    pub absolute: Frame,
    /// Joints for the articulated-body recursion, the other method of computing accelerations.
    pub articulation: Articulation,
    /// Positions of the links' points, if requested and the code is not loops.
    pub positions: Option<Vec<LinkPositions>>,
    /// Balance of force and torque of one link, if the code is loops.
    pub link: Option<LinkBalance>,
    /// Torques that depend on the motion of one joint, if the code is loops.
    pub joint_forces: Option<JointForces>,
    /// Energies, powers and positions of one link, if the code is loops and any of them, or
    /// energies by scale, are requested.
    pub body: Option<LinkBody>,
    /// Energies by scale (by generation of the branching) of one link, if the code is loops and
    /// they are requested.
    pub scales: Option<LinkScales>,
    /// Symmetric coordinates (means and differences of copies), if requested.
    pub coordinates: Vec<Coordinate>,
    /// Mechanics in symmetric coordinates, if requested. For nested copies it contains only
    /// symbols, and the program computes their values from `sectors`.
    pub symmetric: Option<Frame>,
    /// Mechanics by orbits (sets of equal copies of one link) and sectors (sets of symmetric
    /// coordinates: all means, or one difference between copies), if a budget is requested, or
    /// symmetric coordinates of nested copies.
    pub sectors: Option<OrbitMechanics>,
    /// Small differences of an in-phase motion, if requested.
    pub transverse: Option<TransverseMechanics>,
    /// Resonant normal form of degree 4, if requested.
    pub normal_form: Option<NormalFormFormulas>,
    /// Expansion about the in-phase motion, if a transfer is requested.
    pub expansion: Option<MassExpansion>,
    /// The mean tree, if a transfer is requested between copies that differ.
    pub mean_tree: Option<MeanTree>,
    /// Energy transfers, one per difference, if requested.
    pub transfers: Vec<TransferFormulas>,
    /// Observables (quantities that the user defines) with their rates.
    pub observables: Observables,
}

impl Mechanics {
    /// Returns the constant with this symbol, if there is one.
    pub fn constant(&self, symbol: SymbolId) -> Option<&Constant> {
        self.constants.iter().find(|c| c.symbol == symbol)
    }

    /// Returns the index of the constant that represents this one. Of all constants with the same
    /// value and unit it is the one with the shortest name, and of these the first. A constant of
    /// one copy that equals that of all copies is represented by the latter.
    pub fn representative(&self, index: usize) -> usize {
        let Constant { value, unit, .. } = &self.constants[index];
        let equal = self.constants.iter().enumerate();
        let equal = equal.filter(|(_, other)| other.unit == *unit && other.value == *value);
        let length = |constant: &Constant| self.symbols.get(constant.symbol).code.len();
        let shortest = equal.min_by_key(|(_, constant)| length(constant));
        shortest.map_or(index, |(index, _)| index)
    }
}

/// Derives all requested quantities, and nothing else.
///
/// # Errors
/// [`AlgebraError`] if the algebra cannot be used, or if an observable divides
/// by zero.
pub fn derive(scene: &Scene) -> Result<Mechanics, AlgebraError> {
    algebra::run(|| Derivation::new(scene).finish())?
}
