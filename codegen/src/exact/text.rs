//! Parsing and printing of exact numbers.

use std::fmt;

use super::integers::Integer;

use super::{ExactError, Fraction, Rational};

/// Largest number of digits of a terminating decimal that [`Rational`] prints as a decimal; it
/// prints every other number as `n/d`.
const DECIMAL_DIGITS: usize = 25;

impl Rational {
    /// Parses a decimal literal exactly: an optional sign, digits with underscores between them, an
    /// optional decimal point and an optional exponent, as in `1_000`, `.5`, `1.88e-3`. Type
    /// suffixes and other bases are refused.
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
        let mantissa: Integer = mantissa.parse().map_err(|_| ExactError::Malformed)?;
        let power = i64::from(exponent) - fraction.len() as i64;
        let scale = Integer::from(10).pow(power.unsigned_abs());
        let (numerator, denominator) = if power < 0 {
            (mantissa, scale)
        } else {
            (mantissa * scale, Integer::one())
        };
        let value = Self(Fraction::new(numerator, denominator));
        Ok(if negative { -value } else { value })
    }

    /// Returns the terminating decimal expansion, or `None` if there is none of at most
    /// [`DECIMAL_DIGITS`] digits.
    pub(crate) fn terminating_decimal(&self) -> Option<String> {
        let mut ten = Integer::one();
        for places in 0..=DECIMAL_DIGITS {
            let (quotient, rest) = ten.quot_rem(self.0.denominator_ref());
            if rest.is_zero() {
                let digits = (self.0.numerator_ref().abs() * quotient).to_string();
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
            ten *= Integer::from(10);
        }
        None
    }
}

/// Returns `text` without the underscores between its digits.
fn digits(text: &str) -> Result<String, ExactError> {
    text.chars()
        .filter(|&c| c != '_')
        .map(|c| c.is_ascii_digit().then_some(c))
        .collect::<Option<String>>()
        .ok_or(ExactError::Malformed)
}

/// Parses a decimal exponent, at most [`Rational::MAX_EXPONENT`] in magnitude.
fn parse_exponent(text: &str) -> Result<i32, ExactError> {
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let digits = digits(unsigned)?;
    if digits.is_empty() {
        return Err(ExactError::Malformed);
    }
    // A text of digits alone fails to parse only by overflow.
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
            None => write!(f, "{}/{}", self.0.numerator_ref(), self.0.denominator_ref()),
        }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Rational({self})")
    }
}
