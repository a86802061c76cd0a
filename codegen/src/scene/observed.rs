//! Observables as data: quantities of the user's own in the symbols of the scene.

use self::ObservedAtom::Known;
use super::{Quantity, RationalExpression};
use crate::named_members::named_members;

/// A quantity that the description defines by an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// Snake-case name; its functions are called after it.
    pub name: String,
    /// Definition of the observable.
    pub value: Observed,
}

/// An expression in the symbols of the scene. Sums, products, quotients and powers of
/// what is known are one [`ObservedAtom::Known`].
pub type Observed = RationalExpression<ObservedAtom>;

/// What observables are formed of.
#[derive(Debug, Clone, PartialEq)]
pub enum ObservedAtom {
    /// Numbers, parameters, gravity, and what is formed of them.
    Known(Quantity),
    /// A quantity that moves.
    Variable(Variable),
    /// A constant of the model, by its name there; one that the model does not
    /// have is zero.
    Constant(String),
    /// Kinetic energy, J.
    KineticEnergy,
    /// Potential energy, J.
    PotentialEnergy,
    /// A function of a value.
    Call(Function, Box<Observed>),
}

/// A coordinate, or its velocity or momentum.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variable {
    /// Name as the user writes it: `theta_child_1`, `p_d`.
    pub name: String,
    /// Angle, velocity or momentum of the coordinate.
    pub kind: VariableKind,
    /// The coordinate.
    pub coordinate: CoordinateIndex,
}

/// Kind of a [`Variable`] of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariableKind {
    /// The coordinate itself, rad.
    Angle,
    /// Velocity of the coordinate, rad/s.
    Velocity,
    /// The momentum that belongs to it, kg m²/s.
    Momentum,
}

/// A generalized coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateIndex {
    /// The absolute angle of the link with that index.
    Absolute(usize),
    /// The symmetric coordinate with that index.
    Symmetric(usize),
}

named_members! {
    /// Functions of observables.
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
    /// A value that is known.
    pub(super) fn known(quantity: Quantity) -> Self {
        Self::Atom(Known(quantity))
    }

    /// The value if it is known.
    pub(super) fn quantity(&self) -> Option<&Quantity> {
        match self {
            Self::Atom(Known(quantity)) => Some(quantity),
            _ => None,
        }
    }

    /// Returns true if a variable that only the symmetric coordinates have
    /// occurs.
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
