//! Values of a scene: exact numbers, parameters, and what is formed of them.

use super::ParameterId;
use crate::exact::{ExactError, Rational};

/// A value in SI units, known exactly or in terms of parameters.
///
/// The functions that build one fold: an expression of literals only is always
/// [`Quantity::Exact`]; a sum or product holds at most one exact member, which
/// comes first; nothing is multiplied by 0 or 1 or has 0 added; a sum that is 0
/// for all parameters is 0; nothing is divided by an exact number. Members keep
/// the order in which they were written.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// A number.
    Exact(Rational),
    /// A parameter of the model.
    Parameter(ParameterId),
    /// A sum of two or more members.
    Sum(Vec<Quantity>),
    /// A product of two or more factors.
    Product(Vec<Quantity>),
    /// Dividend and divisor.
    Quotient(Box<Quantity>, Box<Quantity>),
    /// An integer power other than 0 and 1.
    Power(Box<Quantity>, i32),
    /// The opposite of a value that is not exact.
    Negative(Box<Quantity>),
}

impl Quantity {
    /// The number 0.
    pub fn zero() -> Self {
        Self::Exact(Rational::zero())
    }

    /// A whole number.
    pub fn integer(value: i64) -> Self {
        Self::Exact(Rational::from(value))
    }

    /// The value where it is known exactly.
    pub fn exact(&self) -> Option<&Rational> {
        match self {
            Self::Exact(value) => Some(value),
            _ => None,
        }
    }

    /// Returns true if the value is 0 whatever the parameters are.
    pub fn is_zero(&self) -> bool {
        self.exact().is_some_and(Rational::is_zero)
    }

    /// The sum of `members`.
    pub fn sum(members: impl IntoIterator<Item = Self>) -> Self {
        Self::sum_of(members.into_iter().collect())
    }

    /// Compiled once, whatever the iterator.
    fn sum_of(members: Vec<Self>) -> Self {
        let mut constant = Rational::zero();
        let mut rest = Vec::new();
        for member in members {
            match member {
                Self::Exact(value) => constant = constant + value,
                Self::Sum(inner) => {
                    for member in inner {
                        match member {
                            Self::Exact(value) => constant = constant + value,
                            other => rest.push(other),
                        }
                    }
                }
                other => rest.push(other),
            }
        }
        if !constant.is_zero() {
            rest.insert(0, Self::Exact(constant));
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
        for factor in factors {
            match factor {
                Self::Exact(value) => constant = constant * value,
                Self::Negative(inner) => {
                    constant = -constant;
                    rest.push(*inner);
                }
                Self::Product(inner) => {
                    for factor in inner {
                        match factor {
                            Self::Exact(value) => constant = constant * value,
                            other => rest.push(other),
                        }
                    }
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
            rest.insert(0, Self::Exact(constant));
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

    /// The opposite.
    pub fn negative(self) -> Self {
        match self {
            Self::Exact(value) => Self::Exact(-value),
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
            Self::Exact(divisor) => {
                let inverse = Rational::one()
                    .checked_div(&divisor)
                    .ok_or(ExactError::DivisionByZero)?;
                Ok(Self::product([self, Self::Exact(inverse)]))
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
            (Self::Exact(value), _) => value.checked_pow(exponent).map(Self::Exact),
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

    /// Calls `visit` with every number and parameter in the value, in the order
    /// written.
    pub fn for_each_leaf<'a>(&'a self, visit: &mut impl FnMut(&'a Self)) {
        match self {
            Self::Exact(_) | Self::Parameter(_) => visit(self),
            Self::Sum(members) | Self::Product(members) => {
                for member in members {
                    member.for_each_leaf(visit);
                }
            }
            Self::Quotient(dividend, divisor) => {
                dividend.for_each_leaf(visit);
                divisor.for_each_leaf(visit);
            }
            Self::Power(base, _) | Self::Negative(base) => base.for_each_leaf(visit),
        }
    }

    /// Returns true if every number in the value rounds to a finite `f64`.
    pub fn is_finite(&self) -> bool {
        let mut finite = true;
        self.for_each_leaf(&mut |leaf| {
            finite &= leaf
                .exact()
                .is_none_or(|number| number.to_f64().is_finite());
        });
        finite
    }
}
