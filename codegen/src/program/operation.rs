//! Values of a program: one operation each, on earlier ones.

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
