//! Values of a scene: exact numbers, parameters, and what is formed of them.

use self::QuantityAtom::Exact;
use super::{ParameterId, RationalExpression};
use crate::exact::{ExactError, Rational};

/// A value in SI units, known exactly or in terms of parameters.
///
/// The functions that build one fold: an expression of literals only is always one
/// number; a sum or product holds at most one number, which comes first; nothing is
/// multiplied by 0 or 1 or has 0 added; a sum that is 0 for all parameters is 0; nothing
/// is divided by a number; no power is 0 or 1; no number has a
/// [`Negative`](RationalExpression::Negative) around it. Members keep the order in which
/// they were written.
pub type Quantity = RationalExpression<QuantityAtom>;

/// What quantities are formed of.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum QuantityAtom {
    /// A number.
    Exact(Rational),
    /// A parameter of the model.
    Parameter(ParameterId),
}

impl Quantity {
    /// A number.
    pub fn number(value: Rational) -> Self {
        Self::Atom(Exact(value))
    }

    /// A parameter.
    pub fn parameter(id: ParameterId) -> Self {
        Self::Atom(QuantityAtom::Parameter(id))
    }

    /// The number 0.
    pub fn zero() -> Self {
        Self::number(Rational::zero())
    }

    /// A whole number.
    pub fn integer(value: i64) -> Self {
        Self::number(Rational::from(value))
    }

    /// The value where it is known exactly.
    pub fn exact(&self) -> Option<&Rational> {
        match self {
            Self::Atom(Exact(value)) => Some(value),
            _ => None,
        }
    }

    /// Returns true if the value is 0 whatever the parameters are.
    pub fn is_zero(&self) -> bool {
        self.exact().is_some_and(Rational::is_zero)
    }

    /// Returns true if a minus stands before all of the value: for a negative number, and
    /// for what is negative where all factors are positive, as `-g` and `-2 * g - h`.
    pub fn is_written_negative(&self) -> bool {
        match self {
            Self::Atom(Exact(value)) => value.is_negative(),
            Self::Atom(QuantityAtom::Parameter(_)) | Self::Power(..) => false,
            Self::Negative(inner) => !inner.is_written_negative(),
            Self::Sum(members) => members.iter().all(Self::is_written_negative),
            Self::Product(factors) => factors.first().is_some_and(Self::is_written_negative),
            Self::Quotient(above, _) => above.is_written_negative(),
        }
    }

    /// The sum of `members`.
    pub fn sum(members: impl IntoIterator<Item = Self>) -> Self {
        Self::sum_of(members.into_iter().collect())
    }

    /// Compiled once, whatever the iterator.
    fn sum_of(members: Vec<Self>) -> Self {
        let mut constant = Rational::zero();
        let mut rest = Vec::new();
        let members = members.into_iter().flat_map(|member| match member {
            Self::Sum(inner) => inner,
            member => vec![member],
        });
        for member in members {
            match member {
                Self::Atom(Exact(value)) => constant = constant + value,
                other => rest.push(other),
            }
        }
        if !constant.is_zero() {
            rest.insert(0, Self::number(constant));
        }
        match Self::collected(rest, Self::zero, Self::Sum) {
            sum @ Self::Sum(_) if sum.vanishes() => Self::zero(),
            sum => sum,
        }
    }

    /// The product of `factors`.
    pub fn product(factors: impl IntoIterator<Item = Self>) -> Self {
        Self::product_of(factors.into_iter().collect())
    }

    /// Compiled once, whatever the iterator.
    fn product_of(factors: Vec<Self>) -> Self {
        let mut constant = Rational::one();
        let mut rest = Vec::new();
        let factors = factors.into_iter().flat_map(|factor| match factor {
            Self::Product(inner) => inner,
            factor => vec![factor],
        });
        for factor in factors {
            match factor {
                Self::Atom(Exact(value)) => constant = constant * value,
                Self::Negative(inner) => {
                    constant = -constant;
                    rest.push(*inner);
                }
                other => rest.push(other),
            }
        }
        if constant.is_zero() {
            return Self::zero();
        }
        let opposite = -&constant;
        if opposite.is_one() && !rest.is_empty() {
            let positive = Self::collected(rest, || Self::integer(1), Self::Product);
            return Self::Negative(Box::new(positive));
        }
        if !constant.is_one() {
            rest.insert(0, Self::number(constant));
        }
        Self::collected(rest, || Self::integer(1), Self::Product)
    }

    /// A sum or product of what folding left over.
    fn collected(
        mut members: Vec<Self>,
        empty: impl FnOnce() -> Self,
        several: impl FnOnce(Vec<Self>) -> Self,
    ) -> Self {
        match members.len() {
            0 | 1 => members.pop().unwrap_or_else(empty),
            _ => several(members),
        }
    }

    /// Returns a multiple of the value.
    pub(super) fn times(&self, count: usize) -> Self {
        // Counts are below 2^32, see `layout::MOST`.
        let count = Self::integer(i64::try_from(count).unwrap_or(i64::MAX));
        Self::product([count, self.clone()])
    }

    /// The opposite.
    pub fn negative(self) -> Self {
        match self {
            Self::Atom(Exact(value)) => Self::number(-value),
            Self::Negative(inner) => *inner,
            other => Self::product([Self::integer(-1), other]),
        }
    }

    /// The quotient `self / divisor`.
    ///
    /// # Errors
    /// [`ExactError::DivisionByZero`] if `divisor` is known to be 0.
    pub fn divided_by(self, divisor: Self) -> Result<Self, ExactError> {
        match divisor {
            Self::Atom(Exact(divisor)) => {
                let inverse = Rational::one()
                    .checked_div(&divisor)
                    .ok_or(ExactError::DivisionByZero)?;
                Ok(Self::product([self, Self::number(inverse)]))
            }
            _ if self.is_zero() => Ok(self),
            divisor => Ok(Self::Quotient(Box::new(self), Box::new(divisor))),
        }
    }

    /// The power `self ^ exponent`; `x ^ 0` is 1.
    ///
    /// # Errors
    /// [`ExactError::DivisionByZero`] for a negative power of a known 0,
    /// [`ExactError::TooLong`] for a number that would not be
    /// [short](Rational::is_short).
    pub fn power(self, exponent: i32) -> Result<Self, ExactError> {
        match (self, exponent) {
            (Self::Atom(Exact(value)), _) => value.checked_pow(exponent).map(Self::number),
            (_, 0) => Ok(Self::integer(1)),
            (value, 1) => Ok(value),
            (Self::Power(base, inner), _) => match inner.checked_mul(exponent) {
                Some(product) => base.power(product),
                None => Err(ExactError::TooLong),
            },
            // Numbers among the factors become one.
            (Self::Product(factors), _) => {
                let powers = factors.into_iter().map(|factor| factor.power(exponent));
                Ok(Self::product(powers.collect::<Result<Vec<_>, _>>()?))
            }
            (value, _) => Ok(Self::Power(Box::new(value), exponent)),
        }
    }
}
