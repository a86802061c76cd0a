//! Exact numbers: what a decimal literal means before anything is rounded.
//!
//! Every literal of a description is read as a rational number and combined
//! exactly; [`Rational::to_f64`] rounds once, at the very end.

mod operators;
mod round;
mod text;
mod turn;

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational as Fraction;
use num_traits::{One, Signed, Zero};

/// An arbitrary-precision rational number, always in lowest terms with a
/// positive denominator.
///
/// Addition, subtraction, multiplication and negation are operators on values
/// and references; division and powers can fail and are the methods
/// [`checked_div`](Self::checked_div) and [`checked_pow`](Self::checked_pow).
#[derive(Clone, PartialEq, Eq)]
pub struct Rational(Fraction);

/// Why an operation on exact numbers gave no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExactError {
    /// The text is not a decimal number.
    Malformed,
    /// The decimal exponent lies outside ±[`Rational::MAX_EXPONENT`].
    Exponent,
    /// Division by zero, or a negative power of zero.
    DivisionByZero,
    /// Numerator or denominator would have more than
    /// [`Rational::MAX_BITS`] bits.
    TooLong,
}

impl fmt::Display for ExactError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Malformed => write!(f, "not a decimal number"),
            Self::Exponent => write!(
                f,
                "decimal exponent outside -{0} to {0}",
                Rational::MAX_EXPONENT
            ),
            Self::DivisionByZero => write!(f, "division by zero"),
            Self::TooLong => write!(
                f,
                "numerator or denominator longer than {} bits",
                Rational::MAX_BITS
            ),
        }
    }
}

impl std::error::Error for ExactError {}

impl Rational {
    /// Largest decimal exponent that a literal may carry, either sign. It
    /// covers every `f64` and keeps `1e999999999` from filling the memory.
    pub const MAX_EXPONENT: i32 = 400;

    /// Longest numerator or denominator, in bits, that
    /// [`checked_pow`](Self::checked_pow) forms and that
    /// [`is_short`](Self::is_short) accepts.
    pub const MAX_BITS: u64 = 8192;

    /// The number 0.
    pub fn zero() -> Self {
        Self(Fraction::zero())
    }

    /// The number 1.
    pub fn one() -> Self {
        Self(Fraction::one())
    }

    /// The quotient of two machine integers; `None` when `denominator` is 0.
    pub fn from_ratio(numerator: i64, denominator: i64) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        Some(Self(Fraction::new(numerator.into(), denominator.into())))
    }

    /// Returns true if the number is 0.
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    /// Returns true if the number is 1.
    pub fn is_one(&self) -> bool {
        self.0.is_one()
    }

    /// Returns true if the number is below 0.
    pub fn is_negative(&self) -> bool {
        self.0.is_negative()
    }

    /// Returns true if the number is an integer.
    pub fn is_integer(&self) -> bool {
        self.0.is_integer()
    }

    /// Returns true if numerator and denominator have at most
    /// [`MAX_BITS`](Self::MAX_BITS) bits each, so that a chain of operations
    /// can be kept from growing without limit.
    pub fn is_short(&self) -> bool {
        self.bits() <= Self::MAX_BITS
    }

    /// Bits of the longer of numerator and denominator.
    fn bits(&self) -> u64 {
        self.0.numer().bits().max(self.0.denom().bits())
    }

    /// The quotient `self / divisor`; `None` when `divisor` is 0.
    pub fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| Self(&self.0 / &divisor.0))
    }

    /// The power `self ^ exponent`; `x ^ 0` is 1 for every `x`.
    ///
    /// # Errors
    /// [`ExactError::DivisionByZero`] for a negative power of zero,
    /// [`ExactError::TooLong`] for a result beyond
    /// [`MAX_BITS`](Self::MAX_BITS).
    pub fn checked_pow(&self, exponent: i32) -> Result<Self, ExactError> {
        if exponent < 0 && self.is_zero() {
            return Err(ExactError::DivisionByZero);
        }
        // 0, 1 and -1 have one bit and stay as short in every power.
        let bits = self.bits();
        if bits > 1 && bits.saturating_mul(exponent.unsigned_abs().into()) > Self::MAX_BITS {
            return Err(ExactError::TooLong);
        }
        Ok(Self(self.0.pow(if bits > 1 {
            exponent
        } else {
            exponent % 2
        })))
    }

    /// The decimal digits of the numerator, with its sign.
    pub fn numerator_text(&self) -> String {
        self.0.numer().to_string()
    }

    /// The decimal digits of the denominator, which is positive.
    pub fn denominator_text(&self) -> String {
        self.0.denom().to_string()
    }

    /// The nearest `f64`, ties to even; numbers beyond the largest finite
    /// `f64` give an infinity, as a decimal literal in Rust source does.
    pub fn to_f64(&self) -> f64 {
        let (numerator, denominator) = (self.0.numer(), self.0.denom());
        let magnitude = round::magnitude_to_f64(numerator.magnitude(), denominator.magnitude());
        if self.is_negative() {
            -magnitude
        } else {
            magnitude
        }
    }

    /// The nearest `f64` and the nearest to what that leaves: together some 106
    /// bits. The second is 0 where the first is exact, not finite, or so small
    /// that the rest is below all `f64`.
    pub fn to_parts(&self) -> (f64, f64) {
        let high = self.to_f64();
        match Self::from_f64(high) {
            Some(rounded) => (high, (self.clone() - rounded).to_f64()),
            None => (high, 0.0),
        }
    }

    /// The value of a finite `f64`; `None` for others.
    pub fn from_f64(value: f64) -> Option<Self> {
        const MANTISSA_BITS: u32 = 52;
        let bits = value.abs().to_bits();
        let (field, fraction) = (bits >> MANTISSA_BITS, bits & ((1 << MANTISSA_BITS) - 1));
        let (mantissa, exponent) = match field {
            0 => (fraction, -1074),
            _ => (fraction | (1 << MANTISSA_BITS), field as i32 - 1075),
        };
        if !value.is_finite() {
            return None;
        }
        let sign = if value < 0.0 { -1 } else { 1 };
        let power = Self::from(2).checked_pow(exponent).ok()?;
        Some(Self::from(sign * mantissa as i64) * power)
    }
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self(Fraction::from(BigInt::from(value)))
    }
}

/// What passes the door to the algebra, which has exact numbers of its own.
#[cfg(feature = "symbolica")]
impl Rational {
    /// The quotient of two integers by their decimal digits, the first with its sign; `None`
    /// for what is no integer and where the second is 0.
    pub(crate) fn from_digits(numerator: &str, denominator: &str) -> Option<Self> {
        let numerator: BigInt = numerator.parse().ok()?;
        let denominator: BigInt = denominator.parse().ok()?;
        (!denominator.is_zero()).then(|| Self(Fraction::new(numerator, denominator)))
    }

    /// The number as a small integer, if it is one.
    pub(crate) fn to_i32(&self) -> Option<i32> {
        self.is_integer()
            .then(|| self.numerator_text().parse().ok())
            .flatten()
    }
}
