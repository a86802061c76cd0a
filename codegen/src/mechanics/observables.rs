//! Observables as they leave the derivation: plain data.

use super::expression::{Expr, SymbolId};
use crate::scene::Function;
use std::collections::BTreeMap;

/// Quantities of the user's own and what their formulas refer to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observables {
    /// The observables, in the order of the description.
    pub list: Vec<ObservableFormulas>,
    /// Functions of whole expressions; arguments hold earlier ones only.
    pub functions: BTreeMap<SymbolId, AppliedFunction>,
    /// Quantities that the observables in absolute angles use.
    pub absolute: ObservableFrame,
    /// Quantities that the observables in symmetric coordinates use.
    pub symmetric: ObservableFrame,
}

/// A function of an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct AppliedFunction {
    /// The function.
    pub function: Function,
    /// Argument of the function.
    pub argument: Expr,
}

/// An observable with its rates of change.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservableFormulas {
    /// Name of the observable.
    pub name: String,
    /// True if its variables are the symmetric ones.
    pub symmetric: bool,
    /// F in coordinates, velocities and momenta.
    pub value: Expr,
    /// dF/dt in the same and in accelerations and forces; with friction.
    pub rate: Expr,
    /// The part of it that is friction and drag.
    pub friction: Expr,
    /// dF/dt by the Poisson bracket, if momenta are asked for.
    pub canonical: Option<CanonicalRate>,
}

/// A rate from coordinates and momenta.
#[derive(Clone, Debug, PartialEq)]
pub struct CanonicalRate {
    /// {F, H} and the part of friction, with the unknowns y of `adjoint`.
    pub rate: Expr,
    /// M y = ∂F/∂v, if velocities occur in F.
    pub adjoint: Option<LinearSystem>,
}

/// A linear system with the mass matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSystem {
    /// The unknowns, for which the system is solved.
    pub unknowns: Vec<SymbolId>,
    /// The right side.
    pub right: Vec<Expr>,
}

/// Symbols that observables of nested trees refer to and that no formula
/// defines: written out, they would fill pages. One for each coordinate; none
/// where none is used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NestedSymbols {
    /// ∂L/∂q_i at fixed velocities, with the drive.
    pub forces: Vec<SymbolId>,
    /// Forces of friction and drag Q_i.
    pub torques: Vec<SymbolId>,
    /// Accelerations by friction and drag alone: M a = Q.
    pub friction_accelerations: Vec<SymbolId>,
    /// ∂H/∂q_i at fixed momenta, with the drive.
    pub slopes: Vec<SymbolId>,
    /// (Ṁ v)_i.
    pub changes: Vec<SymbolId>,
    /// K and U, if observables hold them.
    pub energies: Option<EnergySymbols>,
}

/// Kinetic and potential energy as symbols of their own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnergySymbols {
    /// K.
    pub kinetic: SymbolId,
    /// U.
    pub potential: SymbolId,
    /// ∂K/∂q_i at fixed velocities.
    pub kinetic_slopes: Vec<SymbolId>,
    /// ∂U/∂q_i.
    pub potential_slopes: Vec<SymbolId>,
}

/// Quantities that the rates of one frame refer to, as far as they do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservableFrame {
    /// Generalized accelerations; none where no rate holds them.
    pub accelerations: Vec<SymbolId>,
    /// Accelerations by friction and drag alone: M a = Q.
    pub friction: Option<LinearSystem>,
    /// Symbols that the program forms on means and differences, on nested
    /// trees.
    pub nested: NestedSymbols,
    /// Forces, slopes of H and changes of M in coordinates and velocities.
    pub definitions: BTreeMap<SymbolId, Expr>,
    /// The momenta in coordinates and velocities; none where no observable
    /// holds any.
    pub momentum: Vec<Expr>,
}
