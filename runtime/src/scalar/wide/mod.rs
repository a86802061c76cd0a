//! Double-double numbers.

mod tables;
#[cfg(test)]
mod tests;

use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::sincos::reduction::modulo_half_pi;
use super::{Real, Scalar};

/// Number of about 106 bits: the sum of two `f64`, the second of which is at most half a unit in
/// the last place of the first.
///
/// It is meant for reference values: emitted code on these numbers is accurate to 30 digits, at
/// about twenty times the cost. Constants are the `f64` in the code.
///
/// Relative errors, with u = 2⁻⁵³: sum and difference 3u², product 7u², quotient 15u² (M. Joldes,
/// J.-M. Muller, V. Popescu, ACM Trans. Math. Softw. 44 (2017) 15), sine and cosine 4u² (measured:
/// 1.8u²). Numbers below 2⁻⁹⁰⁰ and above 2⁹⁶⁰ lose the second part.
///
/// # Examples
///
/// ```
/// use branched_pendulum::scalar::{Double, Scalar};
///
/// let third = Double::from_f64(1.0) / Double::from_f64(3.0);
/// assert_eq!(third.high(), 1.0 / 3.0);
/// assert!((third * Double::from_f64(3.0) - Double::from_f64(1.0)).high().abs() < 1e-31);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double {
    high: f64,
    low: f64,
}

/// Returns the rounded sum a + b and its rounding error (Knuth).
#[inline(always)]
pub(crate) fn two_sum<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// Returns the rounded sum and its error like [`two_sum`], for |a| ≥ |b| or a = 0 (Dekker).
#[inline(always)]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Returns the rounded product a · b and its rounding error (Dekker, Numer. Math. 18 (1971) 224):
/// the same two numbers as with a fused multiply-add.
#[inline(always)]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    // 2²⁷ + 1
    let split = |x: f64| {
        let scaled = 134_217_729.0 * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Double {
    const fn of(high: f64, low: f64) -> Self {
        Self { high, low }
    }

    /// Returns `a + b` as a number in two parts, as accurately as it can be represented.
    #[must_use]
    pub fn sum(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low }
    }

    /// Returns the nearest `f64`.
    #[must_use]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// Returns the difference between the number and [`high`](Self::high).
    #[must_use]
    pub const fn low(self) -> f64 {
        self.low
    }

    fn fast_sum(a: f64, b: f64) -> Self {
        let (high, low) = fast_two_sum(a, b);
        Self { high, low }
    }

    fn times(self, factor: f64) -> Self {
        let (product, error) = two_product(self.high, factor);
        Self::fast_sum(product, error + self.low * factor)
    }

    /// Returns the number of the nearest multiple of π/2, modulo 4, and the distance from this
    /// multiple.
    fn modulo_half_pi(self) -> (u64, Self) {
        let (mut quarter, high) = modulo_half_pi(self.high);
        let (more, low) = modulo_half_pi(self.low);
        quarter = quarter.wrapping_add(more);
        // Three passes keep the digits that remain after the first terms cancel.
        let mut terms = [low[2], high[2], low[1], high[1], low[0], high[0]];
        for _ in 0..3 {
            for i in 1..terms.len() {
                (terms[i], terms[i - 1]) = two_sum(terms[i], terms[i - 1]);
            }
        }
        let [.., low, high] = terms;
        let mut rest = Self::fast_sum(high, low);
        // Only if the second part itself exceeds a quarter turn.
        if rest.high.abs() > 0.8 {
            let side = 1.0_f64.copysign(rest.high);
            rest = rest - tables::HALF_PI.times(side);
            quarter = quarter.wrapping_add(if side > 0.0 { 1 } else { u64::MAX });
        }
        (quarter, rest)
    }
}

impl Add for Double {
    type Output = Self;

    /// Adds by algorithm AccurateDWPlusDW of Joldes, Muller and Popescu.
    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let sum = Self::fast_sum(high, error + low);
        Self::fast_sum(sum.high, rest + sum.low)
    }
}

impl Sub for Double {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    /// Multiplies by algorithm DWTimesDW1 of Joldes, Muller and Popescu.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (product, error) = two_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::fast_sum(product, error + cross)
    }
}

impl Div for Double {
    type Output = Self;

    /// Divides by algorithm DWDivDW2 of Joldes, Muller and Popescu.
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.high / other.high;
        let product = other.times(quotient);
        let rest = (self.high - product.high) + (self.low - product.low);
        Self::fast_sum(quotient, rest / other.high)
    }
}

impl Neg for Double {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::of(-self.high, -self.low)
    }
}

impl From<f64> for Double {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::from_f64(value)
    }
}

impl AddAssign for Double {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl PartialOrd for Double {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            unequal => unequal,
        }
    }
}

impl Scalar for Double {
    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::of(value, 0.0)
    }

    #[inline]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::sum(high, low)
    }

    /// Uses Payne and Hanek's reduction with 190 bits, then Taylor series.
    fn sin_cos(self) -> (Self, Self) {
        if !self.high.is_finite() {
            return (Self::NAN, Self::NAN);
        }
        if self.high == 0.0 {
            // A zero keeps its sign.
            return (self, Self::ONE);
        }
        let (quarter, x) = self.modulo_half_pi();
        let square = x * x;
        let series = |terms: &[Self]| {
            let zero = Self::ZERO;
            terms
                .iter()
                .rev()
                .fold(zero, |sum, &term| term + square * sum)
        };
        let sine = x + x * (square * series(&tables::SINE));
        let cosine = Self::ONE + square * series(&tables::COSINE);
        match quarter % 4 {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    /// Takes one step of Newton's method from the root of the first part (A. Karp and P. Markstein,
    /// ACM Trans. Math. Softw. 23 (1997) 561).
    fn sqrt(self) -> Self {
        let root = Scalar::sqrt(self.high);
        if root == 0.0 || !root.is_finite() {
            return Self::from_f64(root);
        }
        let (square, error) = two_product(root, root);
        let rest = (self.high - square) - error + self.low;
        Self::fast_sum(root, rest / (2.0 * root))
    }
}

impl Real for Double {
    const ZERO: Self = Self::of(0.0, 0.0);
    const ONE: Self = Self::of(1.0, 0.0);
    /// 2⁻¹⁰⁴: the relative accuracy that every operation keeps.
    const EPSILON: Self = Self::of(4.930_380_657_631_324e-32, 0.0);
    const NAN: Self = Self::of(f64::NAN, f64::NAN);

    fn to_f64(self) -> f64 {
        self.high
    }

    fn abs(self) -> Self {
        if self.high.is_sign_negative() {
            -self
        } else {
            self
        }
    }

    /// Raises to a power with the accuracy of `f64`, which suffices for step-size control.
    fn powf(self, exponent: Self) -> Self {
        Self::from_f64(Real::powf(self.high, exponent.high))
    }

    fn is_finite(self) -> bool {
        self.high.is_finite()
    }
}

impl fmt::Display for Double {
    /// Writes the two parts of the number as a sum.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.high, f)?;
        if self.low == 0.0 {
            Ok(())
        } else {
            write!(f, "{:+e}", self.low)
        }
    }
}
