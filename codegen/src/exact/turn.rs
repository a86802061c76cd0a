//! Sine and cosine of exact angles.

use super::Rational;

/// Terms of the series: |x| < 7 leaves less than 2^-200 behind them.
const TERMS: i64 = 100;

impl Rational {
    /// Sine and cosine of an angle below 7 rad in magnitude, each to about 150 bits, far
    /// more than a product of them needs that is rounded to `f64` once. Exact at 0.
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

    /// The number cut to the sum of three `f64`, so that a series does not grow.
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
