//! Numbers with 106 bits, for measuring rounding errors: sums of two `f64` that do not overlap (T.
//! J. Dekker, Numerische Mathematik 18 (1971) 224).

use std::ops::{Add, Div, Mul, Neg};

/// A sum of two numbers; the second is at most half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wide {
    pub(super) high: f64,
    low: f64,
}

impl Wide {
    /// Returns a + b exactly, for any order of magnitude.
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        let low = (a - (high - part)) + (b - part);
        Self { high, low }
    }

    /// Returns a · b exactly.
    fn product(a: f64, b: f64) -> Self {
        /// Splits a number into two parts of 26 bits.
        fn split(value: f64) -> (f64, f64) {
            let scaled = value * 134_217_729.0;
            let high = scaled - (scaled - value);
            (high, value - high)
        }
        let high = a * b;
        let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
        let low = a_low * b_low - (((high - a_high * b_high) - a_low * b_high) - a_high * b_low);
        Self { high, low }
    }

    /// Returns the distance between the number and an `f64`.
    pub(super) fn distance(self, rounded: f64) -> f64 {
        (self + Self::from(-rounded)).high.abs()
    }

    /// Returns the square root of a non-negative number.
    pub(super) fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 {
            return Self::from(root);
        }
        let rest = self + -Self::product(root, root);
        Self::sum(root, rest.high / (2.0 * root))
    }
}

impl From<f64> for Wide {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (
            Self::sum(self.high, other.high),
            Self::sum(self.low, other.low),
        );
        let middle = Self::sum(high.high, high.low + low.high);
        Self::sum(middle.high, middle.low + low.low)
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::sum(product.high, product.low + cross)
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self + -(other * Self::from(first));
        let second = rest.high / other.high;
        let rest = rest + -(other * Self::from(second));
        let third = rest.high / other.high;
        Self::sum(first, second) + Self::from(third)
    }
}

#[cfg(test)]
mod tests {
    use super::Wide;

    /// Checks that three times 1/3 is 1 to within 2⁻¹⁰⁴, and that the square of √2 is 2.
    #[test]
    fn quotients_and_roots_have_both_halves() {
        let third = Wide::from(1.0) / Wide::from(3.0);
        assert_eq!(third.high, 1.0 / 3.0);
        let bits = 2.0_f64.powi(-104);
        assert!((third * Wide::from(3.0)).distance(1.0) <= bits);
        let root = Wide::from(2.0).sqrt();
        assert!((root * root).distance(2.0) <= 4.0 * bits);
        // Error that a single `f64` would leave.
        let half = Wide::from(root.high);
        assert!((half * half).distance(2.0) > 1e-17);
    }

    /// Checks that parts far below the sum are not lost.
    #[test]
    fn sums_keep_small_parts() {
        let small = 2.0_f64.powi(-80);
        let sum = Wide::from(1.0) + Wide::from(small);
        assert_eq!((sum + Wide::from(-1.0)).high, small);
    }
}
