//! Observables: quantities that the user defines, as expressions in the symbols of the scene.

use self::ObservedAtom::Known;
use super::{Quantity, RationalExpression};
use crate::named_members::named_members;

/// A quantity that the description defines by an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// Snake-case name, from which the names of its functions are derived.
    pub name: String,
    /// Definition of the observable.
    pub value: Observed,
}

/// An expression in the symbols of the scene. Sums, products, quotients and powers of known values
/// are folded into one [`ObservedAtom::Known`].
pub type Observed = RationalExpression<ObservedAtom>;

/// Operands of observables.
#[derive(Debug, Clone, PartialEq)]
pub enum ObservedAtom {
    /// A value that does not depend on the motion: numbers, parameters, gravity and expressions of
    /// them.
    Known(Quantity),
    /// A quantity that depends on the motion.
    Variable(Variable),
    /// A constant of the model, identified by its name in the emitted code. A constant that does
    /// not occur in the model is zero.
    Constant(String),
    /// Kinetic energy, in J.
    KineticEnergy,
    /// Potential energy, in J.
    PotentialEnergy,
    /// A function of an expression.
    Call(Function, Box<Observed>),
}

/// A coordinate, its velocity or its momentum.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variable {
    /// Name as the user writes it: `theta_child_1`, `p_d`.
    pub name: String,
    /// Angle, velocity or momentum of the coordinate.
    pub kind: VariableKind,
    /// The generalized coordinate that this variable belongs to.
    pub coordinate: CoordinateIndex,
}

/// Kind of a [`Variable`] of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariableKind {
    /// The coordinate itself, in rad.
    Angle,
    /// Velocity of the coordinate, in rad/s.
    Velocity,
    /// Canonical momentum of the coordinate, in kg m²/s.
    Momentum,
}

/// A generalized coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateIndex {
    /// Absolute angle of the link with this index.
    Absolute(usize),
    /// Symmetric coordinate (mean or difference of copies) with this index.
    Symmetric(usize),
}

named_members! {
    /// Functions that observables can use.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Function {
        /// Sine.
        Sin = "sin",
        /// Cosine.
        Cos = "cos",
        /// Square root.
        Sqrt = "sqrt",
    }
}

impl Observed {
    /// Creates an observable from a value that does not depend on the motion.
    pub(super) fn known(quantity: Quantity) -> Self {
        Self::Atom(Known(quantity))
    }

    /// Returns the value if it does not depend on the motion.
    pub(super) fn quantity(&self) -> Option<&Quantity> {
        match self {
            Self::Atom(Known(quantity)) => Some(quantity),
            _ => None,
        }
    }

    /// Returns true if the expression contains a variable that exists in symmetric coordinates
    /// only.
    pub fn is_symmetric(&self) -> bool {
        self.atoms().into_iter().any(|atom| match atom {
            ObservedAtom::Variable(variable) => {
                matches!(variable.coordinate, CoordinateIndex::Symmetric(_))
            }
            ObservedAtom::Call(_, argument) => argument.is_symmetric(),
            _ => false,
        })
    }
}
