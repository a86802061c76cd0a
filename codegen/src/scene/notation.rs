//! Expressions in the attribute's own notation, so that they could be written there again.

use std::fmt::{self, Display, Formatter};

use super::{Observed, Parameter, ParameterId, Quantity, Signal};
use crate::description::TIME;
use crate::exact::Rational;

/// An expression on its way to text.
enum Notation {
    /// A name, or a number in decimals.
    Atom(String),
    /// A number as a fraction.
    Fraction(String),
    Sum(Vec<Notation>),
    Product(Vec<Notation>),
    Quotient(Box<Notation>, Box<Notation>),
    Power(Box<Notation>, i64),
    Negative(Box<Notation>),
    Call(&'static str, Box<Notation>),
}

/// Surroundings of an expression in the text, from loosest to tightest.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Place {
    Sum,
    Term,
    Factor,
    Base,
}

impl Notation {
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
    fn binding(&self) -> Place {
        match self {
            Self::Atom(_) | Self::Call(..) => Place::Base,
            Self::Power(..) => Place::Factor,
            Self::Fraction(_) | Self::Product(_) | Self::Quotient(..) | Self::Negative(_) => {
                Place::Term
            }
            Self::Sum(_) => Place::Sum,
        }
    }

    fn write(&self, place: Place, f: &mut Formatter<'_>) -> fmt::Result {
        match place > self.binding() {
            true => write!(f, "({self})"),
            false => write!(f, "{self}"),
        }
    }
}

impl Display for Notation {
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
                    member.write(Place::Term, f)?;
                }
                Ok(())
            }
            Self::Product(factors) => {
                for (index, factor) in factors.iter().enumerate() {
                    f.write_str(if index > 0 { " * " } else { "" })?;
                    factor.write(Place::Factor, f)?;
                }
                Ok(())
            }
            Self::Quotient(dividend, divisor) => {
                dividend.write(Place::Term, f)?;
                f.write_str(" / ")?;
                divisor.write(Place::Factor, f)
            }
            Self::Power(base, exponent) => {
                base.write(Place::Base, f)?;
                write!(f, "^{exponent}")
            }
            Self::Negative(value) => {
                f.write_str("-")?;
                value.write(Place::Term, f)
            }
            Self::Call(function, argument) => write!(f, "{function}({argument})"),
        }
    }
}

impl Quantity {
    /// The value as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.notation(parameters)
    }

    fn notation(&self, parameters: &[Parameter]) -> Notation {
        let one = |value: &Self| Box::new(value.notation(parameters));
        let all = |values: &[Self]| values.iter().map(|v| v.notation(parameters)).collect();
        match self {
            Self::Exact(number) => Notation::number(number),
            Self::Parameter(ParameterId(index)) => Notation::Atom(match parameters.get(*index) {
                Some(parameter) => parameter.name.clone(),
                None => format!("parameter_{index}"),
            }),
            Self::Sum(members) => Notation::Sum(all(members)),
            Self::Product(factors) => Notation::Product(all(factors)),
            Self::Quotient(dividend, divisor) => Notation::Quotient(one(dividend), one(divisor)),
            Self::Power(base, exponent) => Notation::Power(one(base), i64::from(*exponent)),
            Self::Negative(value) => Notation::Negative(one(value)),
        }
    }
}

impl Observed {
    /// The value as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.notation(parameters)
    }

    fn notation(&self, parameters: &[Parameter]) -> Notation {
        let one = |value: &Self| Box::new(value.notation(parameters));
        let all = |values: &[Self]| values.iter().map(|v| v.notation(parameters)).collect();
        match self {
            Self::Known(quantity) => quantity.notation(parameters),
            Self::Variable(variable) => Notation::Atom(variable.name.clone()),
            Self::Constant(name) => Notation::Atom(name.clone()),
            Self::KineticEnergy => Notation::Atom("kinetic_energy".into()),
            Self::PotentialEnergy => Notation::Atom("potential_energy".into()),
            Self::Sum(members) => Notation::Sum(all(members)),
            Self::Product(factors) => Notation::Product(all(factors)),
            Self::Quotient(dividend, divisor) => Notation::Quotient(one(dividend), one(divisor)),
            Self::Power(base, exponent) => Notation::Power(one(base), i64::from(*exponent)),
            Self::Negative(value) => Notation::Negative(one(value)),
            Self::Call(function, argument) => Notation::Call(function.name(), one(argument)),
        }
    }
}

impl Signal {
    /// The function of time as text. `parameters` are those of the scene.
    pub fn display(&self, parameters: &[Parameter]) -> impl Display {
        self.notation(parameters)
    }

    fn notation(&self, parameters: &[Parameter]) -> Notation {
        let one = |value: &Self| Box::new(value.notation(parameters));
        let all = |values: &[Self]| values.iter().map(|v| v.notation(parameters)).collect();
        match self {
            Self::Constant(quantity) => quantity.notation(parameters),
            Self::Time => Notation::Atom(TIME.into()),
            Self::Sum(members) => Notation::Sum(all(members)),
            Self::Product(factors) => Notation::Product(all(factors)),
            Self::Power(base, exponent) => Notation::Power(one(base), i64::from(*exponent)),
            Self::Function(function, angle) => Notation::Call(function.name(), one(angle)),
        }
    }
}
