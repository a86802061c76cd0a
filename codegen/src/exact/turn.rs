//! Sine and cosine of exactly known angles.

use super::Rational;

/// Number of terms of the Taylor series. For |x| < 7 the rest of the series is below 2^-200.
const TERMS: i64 = 100;

impl Rational {
    /// Returns the sine and cosine of an angle below 7 rad in magnitude, each accurate to about 150
    /// bits. That is far more than a product of the two needs before it is rounded once to `f64`.
    /// Exact at 0.
    pub fn sine_and_cosine(&self) -> (Self, Self) {
        let (mut sine, mut cosine) = (Self::zero(), Self::one());
        let mut term = Self::one();
        for n in 1..TERMS {
            let fraction = Self::from_ratio(1, n).unwrap_or_else(Self::zero);
            term = (&(&term * self) * &fraction).to_bits_of_three();
            let signed = if n % 4 < 2 { term.clone() } else { -&term };
            match n % 2 {
                0 => cosine = &cosine + &signed,
                _ => sine = &sine + &signed,
            }
        }
        (sine.to_bits_of_three(), cosine.to_bits_of_three())
    }

    /// Rounds the number to a sum of three `f64` values, so that the terms of a series stay short.
    fn to_bits_of_three(&self) -> Self {
        let (mut sum, mut rest) = (Self::zero(), self.clone());
        for _ in 0..3 {
            let part = Self::from_f64(rest.to_f64()).unwrap_or_else(Self::zero);
            rest = &rest - &part;
            sum = &sum + &part;
        }
        sum
    }
}
