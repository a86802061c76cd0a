//! Prints expressions in the notation of the attribute, so that they can be copied to a
//! description.

use std::fmt::{self, Display, Formatter};

use super::observed::ObservedAtom;
use super::{Parameter, ParameterId, QuantityAtom, RationalExpression, SignalAtom};
use crate::description::TIME;
use crate::exact::Rational;

/// Values that can be printed in the notation of the attribute.
pub trait Shown {
    /// Converts the value to an expression of texts. `parameters` are those of the scene.
    fn shown(&self, parameters: &[Parameter]) -> ShownExpression;
}

/// An expression whose operands are texts.
type ShownExpression = RationalExpression<ShownAtom>;

/// An operand as text, for printing an expression.
pub struct ShownAtom {
    text: String,
    /// Tightest precedence at which the text needs no parentheses.
    binding: Precedence,
}

/// Precedence of the surroundings of an expression, from loosest to tightest.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Precedence {
    Sum,
    Term,
    Factor,
    Base,
}

impl<A: Shown> RationalExpression<A> {
    /// Returns the value as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.shown(parameters)
    }
}

impl<A: Shown> Shown for RationalExpression<A> {
    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        self.substitute(&|atom| atom.shown(parameters))
    }
}

impl Shown for QuantityAtom {
    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        match self {
            Self::Exact(number) => ShownExpression::number(number),
            Self::Parameter(ParameterId(index)) => match parameters.get(*index) {
                Some(parameter) => ShownExpression::whole(&parameter.name),
                None => ShownExpression::whole(format!("parameter_{index}")),
            },
        }
    }
}

impl Shown for ObservedAtom {
    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        match self {
            Self::Known(quantity) => quantity.shown(parameters),
            Self::Variable(variable) => ShownExpression::whole(&variable.name),
            Self::Constant(name) => ShownExpression::whole(name),
            Self::KineticEnergy => ShownExpression::whole("kinetic_energy"),
            Self::PotentialEnergy => ShownExpression::whole("potential_energy"),
            Self::Call(function, argument) => {
                ShownExpression::call(function.name(), argument.shown(parameters))
            }
        }
    }
}

impl Shown for SignalAtom {
    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        match self {
            Self::Constant(quantity) => quantity.shown(parameters),
            Self::Time => ShownExpression::whole(TIME),
            Self::Function(function, angle) => {
                ShownExpression::call(function.name(), angle.shown(parameters))
            }
        }
    }
}

impl ShownExpression {
    fn whole(text: impl Into<String>) -> Self {
        let (text, binding) = (text.into(), Precedence::Base);
        Self::Atom(ShownAtom { text, binding })
    }

    fn call(function: &str, argument: Self) -> Self {
        Self::whole(format!("{function}({argument})"))
    }

    fn number(number: &Rational) -> Self {
        if number.is_negative() {
            return Self::Negative(Box::new(Self::number(&-number)));
        }
        let text = number.to_string();
        let binding = match text.contains('/') {
            true => Precedence::Term,
            false => Precedence::Base,
        };
        Self::Atom(ShownAtom { text, binding })
    }

    /// Returns the tightest precedence at which the expression needs no parentheses.
    fn binding(&self) -> Precedence {
        match self {
            Self::Atom(atom) => atom.binding,
            Self::Power(..) => Precedence::Factor,
            Self::Product(_) | Self::Quotient(..) | Self::Negative(_) => Precedence::Term,
            Self::Sum(_) => Precedence::Sum,
        }
    }

    fn write(&self, place: Precedence, f: &mut Formatter<'_>) -> fmt::Result {
        match place > self.binding() {
            true => write!(f, "({self})"),
            false => write!(f, "{self}"),
        }
    }
}

impl Display for ShownExpression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Atom(atom) => f.write_str(&atom.text),
            Self::Sum(members) => {
                for (index, member) in members.iter().enumerate() {
                    let (sign, member) = match member {
                        Self::Negative(opposite) if index > 0 => (" - ", &**opposite),
                        member if index > 0 => (" + ", member),
                        member => ("", member),
                    };
                    f.write_str(sign)?;
                    member.write(Precedence::Term, f)?;
                }
                Ok(())
            }
            Self::Product(factors) => {
                for (index, factor) in factors.iter().enumerate() {
                    f.write_str(if index > 0 { " * " } else { "" })?;
                    factor.write(Precedence::Factor, f)?;
                }
                Ok(())
            }
            Self::Quotient(dividend, divisor) => {
                dividend.write(Precedence::Term, f)?;
                f.write_str(" / ")?;
                divisor.write(Precedence::Factor, f)
            }
            Self::Power(base, exponent) => {
                base.write(Precedence::Base, f)?;
                write!(f, "^{exponent}")
            }
            Self::Negative(value) => {
                f.write_str("-")?;
                value.write(Precedence::Term, f)
            }
        }
    }
}
