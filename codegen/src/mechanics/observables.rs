//! Observables as results of the derivation, in plain data.

use super::expression::{Expr, SymbolId};
use crate::scene::Function;
use std::collections::BTreeMap;

/// Observables (quantities that the user defines), and the quantities that their formulas use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observables {
    /// Observables, in the order of the description.
    pub list: Vec<ObservableFormulas>,
    /// Functions of whole expressions; each argument uses earlier functions only.
    pub functions: BTreeMap<SymbolId, AppliedFunction>,
    /// Quantities that observables in absolute angles use.
    pub absolute: ObservableFrame,
    /// Quantities that observables in symmetric coordinates use.
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
    /// True if its variables are those of symmetric coordinates.
    pub symmetric: bool,
    /// The observable F in coordinates, velocities and momenta.
    pub value: Expr,
    /// Rate dF/dt in the same variables and in accelerations and forces, including friction.
    pub rate: Expr,
    /// Part of the rate caused by friction and drag.
    pub friction: Expr,
    /// Rate dF/dt by the Poisson bracket, if momenta are requested.
    pub canonical: Option<CanonicalRate>,
}

/// Rate of an observable from coordinates and momenta.
#[derive(Clone, Debug, PartialEq)]
pub struct CanonicalRate {
    /// Poisson bracket {F, H} plus the part of friction, with the unknowns y of `adjoint`.
    pub rate: Expr,
    /// Linear system M y = ∂F/∂v for the unknowns y, if velocities v occur in the observable F.
    pub adjoint: Option<LinearSystem>,
}

/// A linear system with the mass matrix on its left side.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSystem {
    /// Unknowns of the linear system.
    pub unknowns: Vec<SymbolId>,
    /// Right side of the linear system.
    pub right: Vec<Expr>,
}

/// Symbols without formulas that observables of nested copies use; written out, the formulas would
/// fill pages. Each list has one symbol per coordinate, or is empty if none is used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NestedSymbols {
    /// Forces ∂L/∂q_i at fixed velocities, including the drive.
    pub forces: Vec<SymbolId>,
    /// Generalized forces Q_i of friction and drag.
    pub torques: Vec<SymbolId>,
    /// Accelerations a caused by friction and drag alone: M a = Q.
    pub friction_accelerations: Vec<SymbolId>,
    /// Slopes ∂H/∂q_i at fixed momenta, including the drive.
    pub slopes: Vec<SymbolId>,
    /// Products (Ṁ v)_i of the mass matrix's rate and the velocities.
    pub changes: Vec<SymbolId>,
    /// Symbols of K and U, if observables contain them.
    pub energies: Option<EnergySymbols>,
}

/// Symbols of the kinetic and potential energy and of their slopes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnergySymbols {
    /// Kinetic energy K.
    pub kinetic: SymbolId,
    /// Potential energy U.
    pub potential: SymbolId,
    /// Slopes ∂K/∂q_i at fixed velocities.
    pub kinetic_slopes: Vec<SymbolId>,
    /// Slopes ∂U/∂q_i.
    pub potential_slopes: Vec<SymbolId>,
}

/// Quantities that the rates of one frame use; unused ones are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservableFrame {
    /// Generalized accelerations; empty if no rate contains them.
    pub accelerations: Vec<SymbolId>,
    /// System M a = Q for the accelerations caused by friction and drag alone.
    pub friction: Option<LinearSystem>,
    /// Symbols whose values the program computes on means and differences, for nested copies.
    pub nested: NestedSymbols,
    /// Definitions of forces, slopes of H and changes of M, in coordinates and velocities.
    pub definitions: BTreeMap<SymbolId, Expr>,
    /// Momenta in coordinates and velocities; empty if no observable contains a momentum.
    pub momentum: Vec<Expr>,
}
