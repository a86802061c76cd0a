//! Forward-mode differentiation.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;

/// A number and its derivatives along `N` directions.
///
/// Emitted code that computes with such numbers returns values together with their derivatives,
/// exact up to rounding: `N` columns of a Jacobian, or `N` solutions of the variational equations,
/// for the cost of `N` linear computations. A. Griewank and A. Walther, Evaluating Derivatives, 2nd
/// ed. 2008, ch. 3.
///
/// # Examples
///
/// ```
/// use branched_pendulum::scalar::{Dual, Scalar};
///
/// // d/dx (x sin x) = sin x + x cos x
/// let x = Dual::<f64, 1>::variable(0.7, 0);
/// let y = x * x.sin_cos().0;
/// let (sin, cos) = Scalar::sin_cos(0.7_f64);
/// assert!((y.tangents[0] - (sin + 0.7 * cos)).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T, const N: usize> {
    /// Value of the number.
    pub value: T,
    /// Derivatives along each direction.
    pub tangents: [T; N],
}

impl<T: Scalar, const N: usize> Dual<T, N> {
    /// Creates a constant: all derivatives are zero.
    #[inline(always)]
    #[must_use]
    pub fn constant(value: T) -> Self {
        Self {
            value,
            tangents: [T::from_f64(0.0); N],
        }
    }

    /// Creates the variable of one direction: its derivative is 1 along that direction and 0 along
    /// the others. If `direction` is not below `N`, the result is a constant.
    #[inline(always)]
    #[must_use]
    pub fn variable(value: T, direction: usize) -> Self {
        let mut result = Self::constant(value);
        if let Some(tangent) = result.tangents.get_mut(direction) {
            *tangent = T::from_f64(1.0);
        }
        result
    }

    /// Returns a function of this number by the chain rule, given the function's value and
    /// derivative here.
    #[inline(always)]
    fn chain(self, value: T, slope: T) -> Self {
        let mut result = self;
        result.value = value;
        for tangent in &mut result.tangents {
            *tangent = slope * *tangent;
        }
        result
    }

    #[inline(always)]
    fn with_tangents(self, other: Self, value: T, tangent: impl Fn(T, T) -> T) -> Self {
        let mut result = self;
        result.value = value;
        for i in 0..N {
            result.tangents[i] = tangent(self.tangents[i], other.tangents[i]);
        }
        result
    }
}

impl<T: Scalar, const N: usize> Add for Dual<T, N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with_tangents(other, self.value + other.value, |a, b| a + b)
    }
}

impl<T: Scalar, const N: usize> Sub for Dual<T, N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with_tangents(other, self.value - other.value, |a, b| a - b)
    }
}

impl<T: Scalar, const N: usize> Mul for Dual<T, N> {
    type Output = Self;

    // The product rule: sums in a product are intended.
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (x, y) = (self.value, other.value);
        self.with_tangents(other, x * y, |a, b| a * y + x * b)
    }
}

impl<T: Scalar, const N: usize> Div for Dual<T, N> {
    type Output = Self;

    // The quotient rule: other operations in a quotient are intended.
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        let divisor = other.value;
        self.with_tangents(other, quotient, |a, b| (a - quotient * b) / divisor)
    }
}

impl<T: Scalar, const N: usize> Neg for Dual<T, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let mut result = self;
        result.value = -self.value;
        for tangent in &mut result.tangents {
            *tangent = -*tangent;
        }
        result
    }
}

impl<T: Scalar, const N: usize> Scalar for Dual<T, N> {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }

    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::constant(T::from_parts(high, low))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.chain(sine, cosine), self.chain(cosine, -sine))
    }

    /// Computes the square root. Its derivative at zero is infinite, or NaN if the tangent is zero.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::from_f64(0.5) / root)
    }
}
