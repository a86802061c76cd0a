//! Observables in the attribute's own notation, so that they could be written
//! there again.

use std::fmt;

use super::{Observed, Parameter, Quantity};

/// Precedence strength of a value, and the one that its place asks for.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Precedence {
    Sum,
    Product,
    Factor,
    Atom,
}

impl Observed {
    /// The value as text. `parameters` are those of the scene.
    pub fn display<'a>(&'a self, parameters: &'a [Parameter]) -> impl fmt::Display + 'a {
        ShownObservable {
            value: self,
            parameters,
            place: Precedence::Sum,
        }
    }

    fn binding(&self) -> Precedence {
        match self {
            Self::Known(Quantity::Parameter(_)) => Precedence::Atom,
            Self::Known(Quantity::Exact(number))
                if !number.is_negative() && !number.to_string().contains('/') =>
            {
                Precedence::Atom
            }
            // A quantity may be a sum of its own.
            Self::Known(_) | Self::Sum(_) | Self::Negative(_) => Precedence::Sum,
            Self::Product(_) | Self::Quotient(..) => Precedence::Product,
            Self::Power(..) => Precedence::Factor,
            Self::Variable(_)
            | Self::Constant(_)
            | Self::KineticEnergy
            | Self::PotentialEnergy
            | Self::Call(..) => Precedence::Atom,
        }
    }
}

/// An observable on its way to text.
struct ShownObservable<'a> {
    value: &'a Observed,
    parameters: &'a [Parameter],
    place: Precedence,
}

impl ShownObservable<'_> {
    fn part<'a>(&'a self, value: &'a Observed, place: Precedence) -> ShownObservable<'a> {
        ShownObservable {
            value,
            parameters: self.parameters,
            place,
        }
    }

    fn bare(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use Precedence::{Atom, Factor, Product, Sum};
        match self.value {
            Observed::Known(quantity) => write!(f, "{}", quantity.display(self.parameters)),
            Observed::Variable(variable) => f.write_str(&variable.name),
            Observed::Constant(name) => f.write_str(name),
            Observed::KineticEnergy => f.write_str("kinetic_energy"),
            Observed::PotentialEnergy => f.write_str("potential_energy"),
            Observed::Sum(members) => {
                for (i, member) in members.iter().enumerate() {
                    match member {
                        Observed::Negative(opposite) if i > 0 => {
                            write!(f, " - {}", self.part(opposite, Product))?;
                        }
                        _ if i > 0 => write!(f, " + {}", self.part(member, Product))?,
                        _ => write!(f, "{}", self.part(member, Sum))?,
                    }
                }
                Ok(())
            }
            Observed::Product(factors) => {
                for (i, factor) in factors.iter().enumerate() {
                    let times = if i > 0 { " * " } else { "" };
                    write!(f, "{times}{}", self.part(factor, Factor))?;
                }
                Ok(())
            }
            Observed::Quotient(above, below) => {
                let (above, below) = (self.part(above, Product), self.part(below, Factor));
                write!(f, "{above} / {below}")
            }
            Observed::Power(base, exponent) => {
                write!(f, "{}^{exponent}", self.part(base, Atom))
            }
            Observed::Negative(value) => write!(f, "-{}", self.part(value, Product)),
            Observed::Call(function, argument) => {
                write!(f, "{}({})", function.name(), self.part(argument, Sum))
            }
        }
    }
}

impl fmt::Display for ShownObservable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.value.binding() < self.place {
            write!(f, "(")?;
            self.bare(f)?;
            write!(f, ")")
        } else {
            self.bare(f)
        }
    }
}
