//! Exact numbers read from text, and written as text.

use std::fmt;

use num_bigint::BigInt;
use num_traits::{One as _, Signed as _, Zero as _};

use super::{ExactError, Fraction, Rational};

/// Decimal digits up to which [`Rational`] prints a terminating decimal as
/// such; beyond them, and for every other number, it prints `n/d`.
const DECIMAL_DIGITS: usize = 25;

impl Rational {
    /// Reads a decimal literal exactly: an optional sign, digits with
    /// underscores between them, an optional point and an optional exponent, as
    /// in `1_000`, `.5`, `1.88e-3`. Type suffixes and other bases are refused.
    ///
    /// # Errors
    /// [`ExactError::Malformed`], [`ExactError::Exponent`], or
    /// [`ExactError::TooLong`] for more digits than
    /// [`MAX_BITS`](Self::MAX_BITS) can hold.
    pub fn parse_decimal(text: &str) -> Result<Self, ExactError> {
        let (negative, unsigned) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, parse_exponent(exponent)?),
            None => (unsigned, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let fraction = digits(fraction)?;
        let mantissa = digits(whole)? + fraction.as_str();
        if mantissa.is_empty() {
            return Err(ExactError::Malformed);
        }
        // Each decimal digit takes more than three bits.
        if mantissa.len() as u64 > Self::MAX_BITS / 4 {
            return Err(ExactError::TooLong);
        }
        let mantissa: BigInt = mantissa.parse().map_err(|_| ExactError::Malformed)?;
        // Both are thousands at most.
        let power = exponent - fraction.len() as i32;
        let scale = BigInt::from(10).pow(power.unsigned_abs());
        let (numerator, denominator) = if power < 0 {
            (mantissa, scale)
        } else {
            (mantissa * scale, BigInt::one())
        };
        let value = Self(Fraction::new(numerator, denominator));
        Ok(if negative { -value } else { value })
    }

    /// The terminating decimal expansion, where there is one of at most
    /// [`DECIMAL_DIGITS`] digits.
    fn terminating_decimal(&self) -> Option<String> {
        let mut ten = BigInt::one();
        for places in 0..=DECIMAL_DIGITS {
            if (&ten % self.0.denom()).is_zero() {
                let digits = (self.0.numer().abs() * &ten / self.0.denom()).to_string();
                if digits.len() > DECIMAL_DIGITS {
                    return None;
                }
                let digits = format!("{digits:0>width$}", width = places + 1);
                let (whole, fraction) = digits.split_at(digits.len() - places);
                let sign = if self.is_negative() { "-" } else { "" };
                return Some(if places == 0 {
                    format!("{sign}{whole}")
                } else {
                    format!("{sign}{whole}.{fraction}")
                });
            }
            ten *= 10;
        }
        None
    }
}

/// The digits of `text` without the underscores between them.
fn digits(text: &str) -> Result<String, ExactError> {
    text.chars()
        .filter(|&c| c != '_')
        .map(|c| c.is_ascii_digit().then_some(c))
        .collect::<Option<String>>()
        .ok_or(ExactError::Malformed)
}

/// A decimal exponent within the limit.
fn parse_exponent(text: &str) -> Result<i32, ExactError> {
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let digits = digits(unsigned)?;
    if digits.is_empty() {
        return Err(ExactError::Malformed);
    }
    // Parsing all-digit text fails only by overflow.
    let magnitude: i32 = digits.parse().map_err(|_| ExactError::Exponent)?;
    if magnitude > Rational::MAX_EXPONENT {
        return Err(ExactError::Exponent);
    }
    Ok(if negative { -magnitude } else { magnitude })
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.terminating_decimal() {
            Some(decimal) => f.write_str(&decimal),
            None => write!(f, "{}/{}", self.0.numer(), self.0.denom()),
        }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Rational({self})")
    }
}
