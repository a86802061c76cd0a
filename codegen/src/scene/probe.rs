//! Test whether a value is identically zero for all values of its variables and parameters. It is
//! evaluated numerically at a few points, because the computer algebra comes later and must not
//! divide by zero.

use super::observed::{Function, Observed, ObservedAtom};
use super::{Quantity, QuantityAtom, RationalExpression};
use crate::exact::Rational;

/// Seeds of the points. A value that vanishes at all of them is identically zero, unless it was
/// constructed on purpose.
const POINTS: [u64; 3] = [1, 2, 3];

/// A value, and the largest absolute intermediate value, to which its rounding error is
/// proportional.
#[derive(Clone, Copy)]
struct Probe {
    value: f64,
    size: f64,
}

impl Probe {
    fn leaf(value: f64) -> Self {
        let size = value.abs();
        Self { value, size }
    }

    fn sum(parts: impl Iterator<Item = Self>) -> Self {
        parts.fold(Self::leaf(0.0), |sum, part| Self {
            value: sum.value + part.value,
            size: sum.size.max(part.size),
        })
    }

    fn product(parts: impl Iterator<Item = Self>) -> Self {
        parts.fold(Self::leaf(1.0), |product, part| Self {
            value: product.value * part.value,
            size: product.size * part.size,
        })
    }

    fn divided_by(self, below: Self) -> Self {
        Self {
            value: self.value / below.value,
            size: self.size / below.value.abs(),
        }
    }

    fn power(self, exponent: i32) -> Self {
        let value = self.value.powi(exponent);
        let size = match exponent < 0 {
            true => value.abs(),
            false => self.size.powi(exponent),
        };
        Self { value, size }
    }

    fn negative(self) -> Self {
        Self {
            value: -self.value,
            ..self
        }
    }

    fn of(self, function: Function) -> Self {
        let Self { value, size } = self;
        match function {
            Function::Sin => Self {
                value: value.sin(),
                size,
            },
            Function::Cos => Self::leaf(value.cos()),
            // The argument may be negative: the test only asks if the root is zero.
            Function::Sqrt => Self {
                value: value.abs().sqrt(),
                size: size.sqrt(),
            },
        }
    }

    fn is_zero(self) -> bool {
        self.value.abs() <= 1e-13 * self.size
    }
}

/// Evaluates an expression, given the values of its operands.
fn probe<A>(expression: &RationalExpression<A>, atom: &impl Fn(&A) -> Probe) -> Probe {
    let at = |part: &RationalExpression<A>| probe(part, atom);
    match expression {
        RationalExpression::Atom(own) => atom(own),
        RationalExpression::Sum(parts) => Probe::sum(parts.iter().map(at)),
        RationalExpression::Product(parts) => Probe::product(parts.iter().map(at)),
        RationalExpression::Quotient(above, below) => at(above).divided_by(at(below)),
        RationalExpression::Power(base, exponent) => at(base).power(*exponent),
        RationalExpression::Negative(inner) => at(inner).negative(),
    }
}

impl Observed {
    /// Returns true if the value vanishes at all points, within rounding.
    pub(super) fn is_zero(&self) -> bool {
        POINTS.iter().all(|&point| self.probe(point).is_zero())
    }

    /// Returns true if the value is too large for an `f64` at all points.
    pub(super) fn is_out_of_range(&self) -> bool {
        POINTS
            .iter()
            .all(|&point| self.probe(point).size == f64::INFINITY)
    }

    fn probe(&self, point: u64) -> Probe {
        let named = |name: &str| Probe::leaf(number(name, point));
        probe(self, &|atom| match atom {
            ObservedAtom::Known(quantity) => quantity.probe(point),
            ObservedAtom::Variable(variable) => named(&variable.name),
            ObservedAtom::Constant(name) => named(name),
            ObservedAtom::KineticEnergy => named("kinetic_energy"),
            ObservedAtom::PotentialEnergy => named("potential_energy"),
            ObservedAtom::Call(function, inner) => inner.probe(point).of(*function),
        })
    }
}

impl Quantity {
    /// Returns true if the value is 0 for all values of its parameters: within rounding at all
    /// points, and exactly at one more.
    pub(super) fn vanishes(&self) -> bool {
        POINTS.iter().all(|&point| self.probe(point).is_zero())
            && self.exact_probe().is_some_and(|value| value.is_zero())
    }

    fn probe(&self, point: u64) -> Probe {
        probe(self, &|atom| {
            Probe::leaf(match atom {
                QuantityAtom::Exact(number) => number.to_f64(),
                QuantityAtom::Parameter(id) => number(&format!("parameter {}", id.0), point),
            })
        })
    }

    /// Returns the exact value for one choice of the parameters, each with at least twenty bits;
    /// `None` if the value is undefined or has too many digits.
    pub(super) fn exact_probe(&self) -> Option<Rational> {
        let at = |part: &Self| part.exact_probe();
        match self {
            Self::Atom(QuantityAtom::Exact(number)) => Some(number.clone()),
            Self::Atom(QuantityAtom::Parameter(id)) => {
                let value = number(&format!("parameter {}", id.0), 0);
                Some(Rational::from((value * f64::from(1 << 21)) as i64))
            }
            Self::Sum(parts) => parts
                .iter()
                .try_fold(Rational::zero(), |sum, part| Some(sum + at(part)?)),
            Self::Product(parts) => parts
                .iter()
                .try_fold(Rational::one(), |product, part| Some(product * at(part)?)),
            Self::Quotient(above, below) => at(above)?.checked_div(&at(below)?),
            Self::Power(base, exponent) => at(base)?.checked_pow(*exponent).ok(),
            Self::Negative(inner) => Some(-at(inner)?),
        }
    }
}

/// Returns a number between 0.5 and 1.5, derived from the name and the point by the FNV-1a hash.
fn number(name: &str, point: u64) -> f64 {
    let hash = name
        .bytes()
        .chain(point.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    0.5 + (hash >> 11) as f64 / (1_u64 << 53) as f64
}
