//! Expressions in the attribute's own notation, so that they could be written there again.

use std::fmt::{self, Display, Formatter};

use super::{Observed, Parameter, ParameterId, Quantity, Signal};
use crate::description::TIME;
use crate::exact::Rational;

/// An expression on its way to text.
enum ShownExpression {
    /// A name, or a number in decimals.
    Atom(String),
    /// A number as a fraction.
    Fraction(String),
    Sum(Vec<ShownExpression>),
    Product(Vec<ShownExpression>),
    Quotient(Box<ShownExpression>, Box<ShownExpression>),
    Power(Box<ShownExpression>, i64),
    Negative(Box<ShownExpression>),
    Call(&'static str, Box<ShownExpression>),
}

/// Surroundings of an expression in the text, from loosest to tightest.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Precedence {
    Sum,
    Term,
    Factor,
    Base,
}

impl ShownExpression {
    fn number(number: &Rational) -> Self {
        if number.is_negative() {
            return Self::Negative(Box::new(Self::number(&-number)));
        }
        let text = number.to_string();
        match text.contains('/') {
            true => Self::Fraction(text),
            false => Self::Atom(text),
        }
    }

    /// The tightest place in which the expression needs no parentheses.
    fn binding(&self) -> Precedence {
        match self {
            Self::Atom(_) | Self::Call(..) => Precedence::Base,
            Self::Power(..) => Precedence::Factor,
            Self::Fraction(_) | Self::Product(_) | Self::Quotient(..) | Self::Negative(_) => {
                Precedence::Term
            }
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
            Self::Atom(text) | Self::Fraction(text) => f.write_str(text),
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
            Self::Call(function, argument) => write!(f, "{function}({argument})"),
        }
    }
}

impl Quantity {
    /// The value as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.shown(parameters)
    }

    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        let one = |value: &Self| Box::new(value.shown(parameters));
        let all = |values: &[Self]| values.iter().map(|v| v.shown(parameters)).collect();
        match self {
            Self::Exact(number) => ShownExpression::number(number),
            Self::Parameter(ParameterId(index)) => {
                ShownExpression::Atom(match parameters.get(*index) {
                    Some(parameter) => parameter.name.clone(),
                    None => format!("parameter_{index}"),
                })
            }
            Self::Sum(members) => ShownExpression::Sum(all(members)),
            Self::Product(factors) => ShownExpression::Product(all(factors)),
            Self::Quotient(dividend, divisor) => {
                ShownExpression::Quotient(one(dividend), one(divisor))
            }
            Self::Power(base, exponent) => ShownExpression::Power(one(base), i64::from(*exponent)),
            Self::Negative(value) => ShownExpression::Negative(one(value)),
        }
    }
}

impl Observed {
    /// The value as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.shown(parameters)
    }

    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        let one = |value: &Self| Box::new(value.shown(parameters));
        let all = |values: &[Self]| values.iter().map(|v| v.shown(parameters)).collect();
        match self {
            Self::Known(quantity) => quantity.shown(parameters),
            Self::Variable(variable) => ShownExpression::Atom(variable.name.clone()),
            Self::Constant(name) => ShownExpression::Atom(name.clone()),
            Self::KineticEnergy => ShownExpression::Atom("kinetic_energy".into()),
            Self::PotentialEnergy => ShownExpression::Atom("potential_energy".into()),
            Self::Sum(members) => ShownExpression::Sum(all(members)),
            Self::Product(factors) => ShownExpression::Product(all(factors)),
            Self::Quotient(dividend, divisor) => {
                ShownExpression::Quotient(one(dividend), one(divisor))
            }
            Self::Power(base, exponent) => ShownExpression::Power(one(base), i64::from(*exponent)),
            Self::Negative(value) => ShownExpression::Negative(one(value)),
            Self::Call(function, argument) => ShownExpression::Call(function.name(), one(argument)),
        }
    }
}

impl Signal {
    /// The function of time as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.shown(parameters)
    }

    fn shown(&self, parameters: &[Parameter]) -> ShownExpression {
        let one = |value: &Self| Box::new(value.shown(parameters));
        let all = |values: &[Self]| values.iter().map(|v| v.shown(parameters)).collect();
        match self {
            Self::Constant(quantity) => quantity.shown(parameters),
            Self::Time => ShownExpression::Atom(TIME.into()),
            Self::Sum(members) => ShownExpression::Sum(all(members)),
            Self::Product(factors) => ShownExpression::Product(all(factors)),
            Self::Power(base, exponent) => ShownExpression::Power(one(base), i64::from(*exponent)),
            Self::Function(function, angle) => ShownExpression::Call(function.name(), one(angle)),
        }
    }
}
