//! Values of a scene: exact numbers, parameters and expressions of them.

use self::QuantityAtom::Exact;
use super::{ParameterId, RationalExpression};
use crate::exact::{ExactError, Rational};

/// A value in SI units, known exactly or as an expression of parameters.
///
/// The constructors fold constants: an expression of literals is one number; a sum or product
/// contains at most one number, which comes first; there are no factors 0 or 1 and no summand 0; a
/// sum that is 0 for all parameters is 0; a product or quotient from which all parameters cancel is
/// a number; nothing is divided by a number; no power is 0 or 1; no number has a
/// [`Negative`](RationalExpression::Negative) around it. Members keep the order in which they were
/// written.
pub type Quantity = RationalExpression<QuantityAtom>;

/// Operands of quantities.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum QuantityAtom {
    /// A number.
    Exact(Rational),
    /// A parameter of the model.
    Parameter(ParameterId),
}

impl Quantity {
    /// Creates the value of an exact number.
    pub fn number(value: Rational) -> Self {
        Self::Atom(Exact(value))
    }

    /// Creates the value of a parameter.
    pub fn parameter(id: ParameterId) -> Self {
        Self::Atom(QuantityAtom::Parameter(id))
    }

    /// Returns the number 0.
    pub fn zero() -> Self {
        Self::number(Rational::zero())
    }

    /// Returns an integer as a value.
    pub fn integer(value: i64) -> Self {
        Self::number(Rational::from(value))
    }

    /// Returns the exact value, or `None` if it depends on parameters.
    pub fn exact(&self) -> Option<&Rational> {
        match self {
            Self::Atom(Exact(value)) => Some(value),
            _ => None,
        }
    }

    /// Returns true if the value is 0 for all values of the parameters.
    pub fn is_zero(&self) -> bool {
        self.exact().is_some_and(Rational::is_zero)
    }

    /// Returns true if a minus sign precedes the whole value: a negative number, or an expression
    /// such as `-g` and `-2 * g - h`, which is negative if all parameters are positive.
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

    /// Returns the sum of `members`.
    pub fn sum(members: impl IntoIterator<Item = Self>) -> Self {
        Self::sum_of(members.into_iter().collect())
    }

    /// Adds the members. Takes a `Vec` so that the function is compiled only once.
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

    /// Returns the product of `factors`.
    pub fn product(factors: impl IntoIterator<Item = Self>) -> Self {
        Self::product_of(factors.into_iter().collect())
    }

    /// Multiplies the factors. Takes a `Vec` so that the function is compiled only once.
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
        // Without one of these, no factor can cancel another one.
        let divides = |factor: &Self| match factor {
            Self::Quotient(..) => true,
            Self::Power(_, exponent) => *exponent < 0,
            Self::Atom(_) | Self::Sum(_) | Self::Product(_) | Self::Negative(_) => false,
        };
        if rest.iter().any(divides) {
            let product = Self::collected(rest, || Self::integer(1), Self::Product);
            match product.or_its_number() {
                Self::Atom(Exact(number)) => return Self::number(constant * number),
                Self::Product(factors) => rest = factors,
                factor => rest = vec![factor],
            }
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

    /// Combines the members that remain after folding constants into a sum or a product.
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

    /// Returns `count` times the value.
    pub(super) fn times(&self, count: usize) -> Self {
        // Counts are below 2^32, see `layout::MOST`.
        let count = Self::integer(i64::try_from(count).unwrap_or(i64::MAX));
        Self::product([count, self.clone()])
    }

    /// Returns the value with the opposite sign.
    pub fn negative(self) -> Self {
        match self {
            Self::Atom(Exact(value)) => Self::number(-value),
            Self::Negative(inner) => *inner,
            other => Self::product([Self::integer(-1), other]),
        }
    }

    /// Returns the quotient `self / divisor`.
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
            divisor => Ok(Self::Quotient(Box::new(self), Box::new(divisor)).or_its_number()),
        }
    }

    /// Returns the number that the value is for all parameters, as `-2 * a / a` is −2, or the value
    /// unchanged if it depends on parameters.
    fn or_its_number(self) -> Self {
        match self.exact_probe() {
            Some(number) if Self::Sum(vec![self.clone(), Self::number(-&number)]).vanishes() => {
                Self::number(number)
            }
            _ => self,
        }
    }

    /// Returns the power `self ^ exponent`; `x ^ 0` is 1.
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
            // Fold the powers of the numbers among the factors.
            (Self::Product(factors), _) => {
                let powers = factors.into_iter().map(|factor| factor.power(exponent));
                Ok(Self::product(powers.collect::<Result<Vec<_>, _>>()?))
            }
            (value, _) => Ok(Self::Power(Box::new(value), exponent)),
        }
    }
}
