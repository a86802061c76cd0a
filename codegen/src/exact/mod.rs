//! Exact rational numbers: the values of decimal literals before any rounding.
//!
//! Every literal of a description is read as a rational number, and all arithmetic on it is exact;
//! [`Rational::to_f64`] rounds once, at the very end.

mod integers;
mod operators;
mod round;
mod text;
mod turn;

use std::fmt;

use self::integers::Fraction;

/// An arbitrary-precision rational number, always in lowest terms with a
/// positive denominator.
///
/// Addition, subtraction, multiplication and negation are operators on values
/// and references; division and powers can fail and are the methods
/// [`checked_div`](Self::checked_div) and [`checked_pow`](Self::checked_pow).
#[derive(Clone, PartialEq, Eq)]
pub struct Rational(Fraction);

/// Reason why an operation on exact numbers has no result.
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
    /// Largest magnitude of the decimal exponent of a literal. It covers every `f64` and prevents
    /// `1e999999999` from filling the memory.
    pub const MAX_EXPONENT: i32 = 400;

    /// Largest length of a numerator or denominator, in bits, that
    /// [`checked_pow`](Self::checked_pow) returns and that [`is_short`](Self::is_short) accepts.
    pub const MAX_BITS: u64 = 8192;

    /// Returns the number 0.
    pub fn zero() -> Self {
        Self(Fraction::zero())
    }

    /// Returns the number 1.
    pub fn one() -> Self {
        Self(Fraction::one())
    }

    /// Returns the quotient of two machine integers, or `None` if `denominator` is 0.
    pub fn from_ratio(numerator: i64, denominator: i64) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        // Integers of arbitrary length, because the sign moves to the numerator and `-i64::MIN`
        // does not fit into an `i64`.
        Some(Self(Fraction::new(
            i128::from(numerator),
            i128::from(denominator),
        )))
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

    /// Returns true if numerator and denominator have at most [`MAX_BITS`](Self::MAX_BITS) bits
    /// each. Callers use it to stop a chain of operations from growing without limit.
    pub fn is_short(&self) -> bool {
        self.bits() <= Self::MAX_BITS
    }

    /// Returns the number of bits of the longer of numerator and denominator.
    fn bits(&self) -> u64 {
        let numerator = self.0.numerator_ref().abs().significant_bits();
        numerator.max(self.0.denominator_ref().significant_bits())
    }

    /// Returns the quotient `self / divisor`, or `None` if `divisor` is 0.
    pub fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| Self(&self.0 / &divisor.0))
    }

    /// Returns the power `self ^ exponent`; `x ^ 0` is 1 for every `x`.
    ///
    /// # Errors
    /// [`ExactError::DivisionByZero`] for a negative power of zero,
    /// [`ExactError::TooLong`] for a result beyond
    /// [`MAX_BITS`](Self::MAX_BITS).
    pub fn checked_pow(&self, exponent: i32) -> Result<Self, ExactError> {
        if exponent < 0 && self.is_zero() {
            return Err(ExactError::DivisionByZero);
        }
        let magnitude = u64::from(exponent.unsigned_abs());
        // 0, 1 and -1 have one bit each, and so does every power of them.
        let bits = self.bits();
        if bits > 1 && bits.saturating_mul(magnitude) > Self::MAX_BITS {
            return Err(ExactError::TooLong);
        }
        let magnitude = if bits > 1 {
            magnitude
        } else {
            2 - magnitude % 2
        };
        if exponent == 0 {
            return Ok(Self::one());
        }
        let power = self.0.pow(magnitude);
        Ok(Self(if exponent < 0 { power.inv() } else { power }))
    }

    /// Returns the decimal digits of the numerator, with its sign.
    pub fn numerator_text(&self) -> String {
        self.0.numerator_ref().to_string()
    }

    /// Returns the decimal digits of the denominator, which is positive.
    pub fn denominator_text(&self) -> String {
        self.0.denominator_ref().to_string()
    }

    /// Returns the nearest `f64`, ties to even. Numbers beyond the largest finite `f64` become an
    /// infinity, as a decimal literal in Rust source does.
    pub fn to_f64(&self) -> f64 {
        let magnitude =
            round::magnitude_to_f64(&self.0.numerator_ref().abs(), self.0.denominator_ref());
        if self.is_negative() {
            -magnitude
        } else {
            magnitude
        }
    }

    /// Splits the number into the nearest `f64` and the `f64` nearest to the remainder: together
    /// about 106 bits. The second is 0 if the first is exact or infinite, or if the remainder is
    /// smaller than every positive `f64`.
    pub fn to_parts(&self) -> (f64, f64) {
        let high = self.to_f64();
        match Self::from_f64(high) {
            Some(rounded) => (high, (self.clone() - rounded).to_f64()),
            None => (high, 0.0),
        }
    }

    /// Converts a finite `f64` exactly; returns `None` for an infinity or NaN.
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
        Self(Fraction::new(value, 1))
    }
}

/// Conversions from and to the computer algebra, which uses the same representation.
#[cfg(feature = "symbolica")]
impl Rational {
    /// Borrows the number as the type of the computer algebra.
    pub(crate) fn as_inner(&self) -> &Fraction {
        &self.0
    }

    /// Creates a number from the type of the computer algebra.
    pub(crate) fn from_inner(inner: Fraction) -> Self {
        Self(inner)
    }

    /// Converts the number to an `i32`, if it is an integer in that range.
    pub(crate) fn to_i32(&self) -> Option<i32> {
        self.is_integer()
            .then(|| self.numerator_text().parse().ok())
            .flatten()
    }
}
