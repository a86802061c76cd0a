//! The symbolic derivation: from a scene to its mechanics.
//!
//! Everything here is derived from the positions of the links; the closed
//! forms of the literature are what tests compare with. Inside, formulas are
//! Symbolica's (behind [`algebra`]); what leaves is plain data.

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
    /// Row, at least `column`.
    pub row: usize,
    /// Column.
    pub column: usize,
    /// Value, never zero.
    pub value: Expr,
}

/// Kinetic and potential part of an energy; of a transfer W of the energy H_d = T + V, the
/// parts {H_d, K − T} and {H_d, U − V} that those of the rest of the tree contribute.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyParts<F = Expr> {
    /// The kinetic part.
    pub kinetic: F,
    /// The potential part.
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

/// The Lagrangian in one set of generalized coordinates and what follows from
/// it. Equations of motion: Σ_j M_ij q̈_j + bias_i = 0.
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
    /// Second derivatives of the potential energy, likewise, if modes are asked
    /// for.
    pub stiffness: Option<Vec<MatrixEntry>>,
    /// Kinetic energy in coordinates and velocities and potential energy, zero
    /// where all coordinates are zero; if energies are asked for.
    pub energies: Option<EnergyParts>,
    /// p_i = ∂L/∂v_i in coordinates and velocities, if momenta are asked for.
    pub momentum: Option<Vec<Expr>>,
    /// ṗ_i = ∂L/∂q_i + Q_i, friction, drag and drive included, in coordinates
    /// and velocities, if momenta are asked for.
    pub momentum_rates: Option<Vec<Expr>>,
    /// Torques of friction that is not viscous, as far as symbols stand for them.
    pub torques: Vec<BrakingTorque>,
    /// Generalized forces −∂R/∂v_i of friction and drag, zero where there are
    /// none; contained in `bias` with the opposite sign.
    pub dissipative_forces: Vec<Expr>,
    /// Generalized forces Q_i(t, q) of the drive, zero where there are none;
    /// contained in `bias` with the opposite sign.
    pub drive: Vec<Expr>,
    /// Centrifugal, gravity, friction and drive terms of the Euler–Lagrange
    /// equations.
    pub bias: Vec<Expr>,
}

/// The energy of one difference and the transfer into it. Symbols: symmetric
/// coordinates and their momenta; in-phase velocities w in the truncated
/// forms, generalized velocities in the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFormulas {
    /// Index of the difference among the symmetric coordinates.
    pub coordinate: usize,
    /// H_d, its kinetic and its potential part.
    pub energy: EnergyParts,
    /// W through the orders asked for: to first order in the difference angles (the paper's
    /// W_K, W_P), to second order in the amplitude, then others.
    pub truncated: Vec<Truncated>,
    /// The coefficients of p_d², p_d θ_d, θ_d² in W to second order in the amplitude, if it
    /// is a quadratic form in this difference alone.
    pub quadratic_form: Option<[Expr; 3]>,
    /// W without truncation.
    pub exact: Option<EnergyParts>,
    /// The rate between copies that differ, as what the mean tree does, in its velocities, and
    /// what the mismatch adds.
    pub split: Option<[EnergyParts; 2]>,
    /// The power of friction and drag on H_d; zero without both.
    pub friction: Expr,
    /// The power of the drive on H_d; zero without a moving pivot.
    pub drive: Expr,
    /// ∂H_d/∂p_d, by which torques on the difference have power.
    pub velocity: Expr,
}

impl TransferFormulas {
    /// W through an order, if it is asked for.
    pub fn truncated(&self, counting: Counting, order: u32) -> Option<&EnergyParts> {
        let mut all = self.truncated.iter();
        let found = all.find(|form| (form.counting, form.order) == (counting, order));
        found.map(|form| &form.parts)
    }
}

/// W cut off at an order.
#[derive(Clone, Debug, PartialEq)]
pub struct Truncated {
    /// Quantities that count as small.
    pub counting: Counting,
    /// The highest order kept.
    pub order: u32,
    /// W, in the symbols of the expansion's corrections.
    pub parts: EnergyParts,
}

/// Velocities of one order of their series.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction<F = Expr> {
    /// In-phase velocities, in the order of the means; none where all vanish.
    pub in_phase: Vec<SymbolId>,
    /// M⁽⁰⁾ x = right defines them.
    pub right: Vec<F>,
    /// Velocities of differences, with their values.
    pub differences: Vec<(SymbolId, F)>,
}

/// The inverse mass matrix about the in-phase motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MassExpansion {
    /// Indices of the in-phase coordinates (means).
    pub in_phase: Vec<usize>,
    /// Symbols of w = M⁽⁰⁾⁻¹ p for the in-phase coordinates.
    pub velocities: Vec<SymbolId>,
    /// In-phase block of M⁽⁰⁾; rows and columns count in `in_phase`.
    pub leading: Vec<MatrixEntry>,
    /// Velocities of higher orders, each in terms of earlier ones.
    pub corrections: Vec<Correction>,
    /// w and the inverse mass matrix solved and written out, for small blocks.
    pub written_out: Option<WrittenOut>,
}

/// The mean tree of one whose copies differ.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanTree {
    /// Mechanics of the mean tree, in the symmetric coordinates of the tree.
    pub frame: Frame,
    /// The velocities that the mismatch adds at given momenta; solved for with the mass
    /// matrix of the mean tree.
    pub added: LinearSystem,
}

/// Formulas for people: what the code solves, written out.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenOut {
    /// The symbol D.
    pub determinant: SymbolId,
    /// D, the determinant of the in-phase block.
    pub determinant_value: Expr,
    /// w for each in-phase coordinate.
    pub velocities: Vec<Expr>,
    /// M̃⁻¹ at the in-phase motion, dense.
    pub inverse: Vec<Vec<Expr>>,
    /// First-order correction of M̃⁻¹ in the difference angles, dense.
    pub inverse_first_order: Vec<Vec<Expr>>,
}

/// Everything derived for a scene. Invariants: mass matrices symmetric and
/// zero between unrelated branches; K = ½ vᵀ M v.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanics {
    /// All symbols.
    pub symbols: Symbols,
    /// Symbols of the scene's parameters, in their order.
    pub parameters: Vec<SymbolId>,
    /// Meaning of the angles and rates of joints.
    pub joints: BTreeMap<SymbolId, JointDifference>,
    /// Meaning of the symbols of straight springs' lines.
    pub lines: BTreeMap<SymbolId, LineMeaning>,
    /// Meaning of every trigonometric symbol.
    pub trigonometry: BTreeMap<SymbolId, Trigonometric>,
    /// Combinations of differences whose sine and versine appear.
    pub combinations: Vec<AngleCombination>,
    /// Constants of the model, in the order of their symbols.
    pub constants: Vec<Constant>,
    /// The drive, if the scene has one.
    pub drive: Option<DriveTerms>,
    /// Power −2 R of friction and drag, if there are any, where energies are asked for
    /// and a drive or torques from outside feed them; not of trees in loops.
    pub friction_power: Option<Expr>,
    /// The mechanics in absolute angles; without coordinates where the code is loops.
    pub absolute: Frame,
    /// The joints, from which their accelerations can be formed as well.
    pub articulation: Articulation,
    /// Positions of the links' points, if asked for and not in loops.
    pub positions: Option<Vec<LinkPositions>>,
    /// The balance of one link, where the code is loops.
    pub link: Option<LinkBalance>,
    /// Torques of one link by its own motion, where the code is loops.
    pub joint_forces: Option<JointForces>,
    /// Energies, powers and positions of one link, where the code is loops and any of them or
    /// energies by scale are asked for.
    pub body: Option<LinkBody>,
    /// Energies by scale of one link, where the code is loops and they are asked for.
    pub scales: Option<LinkScales>,
    /// The symmetric coordinates, if asked for.
    pub coordinates: Vec<Coordinate>,
    /// The mechanics in symmetric coordinates, if asked for. On nested trees its
    /// symbols alone: the program is formed from `sectors` there.
    pub symmetric: Option<Frame>,
    /// The mechanics by orbits and sectors, if a budget is asked for, or
    /// symmetric coordinates of a nested tree.
    pub sectors: Option<OrbitMechanics>,
    /// Small differences beside an in-phase motion, if asked for.
    pub transverse: Option<TransverseMechanics>,
    /// Expansion about the in-phase motion, if a transfer is asked for.
    pub expansion: Option<MassExpansion>,
    /// The mean tree, if a transfer is asked for between copies that differ.
    pub mean_tree: Option<MeanTree>,
    /// Energy transfers, one for each difference, if asked for.
    pub transfers: Vec<TransferFormulas>,
    /// Quantities of the user's own with their rates.
    pub observables: Observables,
}

impl Mechanics {
    /// The constant behind a symbol, if it is one.
    pub fn constant(&self, symbol: SymbolId) -> Option<&Constant> {
        self.constants.iter().find(|c| c.symbol == symbol)
    }

    /// The constant, by its index, whose place a constant takes: of all that have the same
    /// value in the same unit, the one of the shortest name, and of these the first. That of
    /// copies that do not differ in it is the one of all copies, where there is one.
    pub fn representative(&self, index: usize) -> usize {
        let Constant { value, unit, .. } = &self.constants[index];
        let equal = self.constants.iter().enumerate();
        let equal = equal.filter(|(_, other)| other.unit == *unit && other.value == *value);
        let length = |constant: &Constant| self.symbols.get(constant.symbol).code.len();
        let shortest = equal.min_by_key(|(_, constant)| length(constant));
        shortest.map_or(index, |(index, _)| index)
    }
}

/// Derives what the scene asks for, and nothing else.
///
/// # Errors
/// [`AlgebraError`] if the algebra cannot be used, or if an observable divides
/// by zero.
pub fn derive(scene: &Scene) -> Result<Mechanics, AlgebraError> {
    algebra::run(|| Derivation::new(scene).finish())?
}
