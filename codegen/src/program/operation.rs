//! Values of a program: each is one operation on earlier values.

use crate::functions::Argument;

use super::ConstantId;
use crate::exact::Rational;

/// Index of a value in [`Program::definitions`](super::Program::definitions).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ValueId(pub u32);

/// One operation. Operands are earlier values.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Op {
    /// An element of an argument.
    Input(Argument, usize),
    /// A constant of the model.
    Constant(ConstantId),
    /// A number that is known when the code is emitted.
    Number(Rational),
    /// Sine. The `Cos` of the same operand is computed together with it.
    Sin(ValueId),
    /// Cosine.
    Cos(ValueId),
    /// Square root.
    Sqrt(ValueId),
    /// Change of sign.
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
    /// Returns the operands, at most two.
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

    /// Returns this operation with its operands replaced by `of`.
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

/// A value: its operation, and a name if it has a meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The operation that computes the value.
    pub op: Op,
    /// Name in emitted code; unnamed values are written in place.
    pub name: Option<String>,
    /// Suggested name, used if the emitted code needs one.
    pub hint: Option<String>,
}
