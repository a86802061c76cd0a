//! The numbers that emitted code and integrators compute with.
//!
//! Two traits, because two kinds of code ask for different things.
//! [`Scalar`] is what straight-line emitted code needs: arithmetic, sine and
//! cosine, square root. It has no ordering, so that SIMD lanes, dual numbers
//! and double-double numbers can implement it. [`Real`] adds what step-size
//! control needs: comparison, absolute value, a real power.

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "branched-pendulum needs sine, cosine and square root: \
     enable the feature `std`, or `libm` for targets without it"
);

/// A number that emitted code can compute with.
///
/// Nothing here compares values: one body of emitted code serves plain
/// numbers, SIMD lanes, dual numbers and extended precision alike.
///
/// # Examples
///
/// ```
/// use branched_pendulum::scalar::Scalar;
///
/// fn norm<T: Scalar>(x: T, y: T) -> T {
///     (x * x + y * y).sqrt()
/// }
///
/// assert_eq!(norm(3.0_f64, 4.0), 5.0);
/// assert_eq!(norm(3.0_f32, 4.0), 5.0);
/// ```
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The value of this type nearest to `value`; for lanes, the same value in
    /// each. Used for constants, and for them only.
    fn from_f64(value: f64) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// Square root.
    fn sqrt(self) -> Self;
}

/// A real number with an order: what step-size control needs besides
/// [`Scalar`].
pub trait Real: Scalar + PartialOrd + AddAssign + Display {
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Distance from one to the next larger number.
    const EPSILON: Self;
    /// Not a number; what an impossible request is answered with.
    const NAN: Self;

    /// The value as `f64`, rounded where the type holds more.
    fn to_f64(self) -> f64;

    /// Absolute value.
    fn abs(self) -> Self;

    /// `self` to the power `exponent`, for `self >= 0`.
    fn powf(self, exponent: Self) -> Self;

    /// Whether the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// The larger of two numbers; `self` if either is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// The smaller of two numbers; `self` if either is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

macro_rules! implement_scalar {
    ($float:ident, $sincos:ident, $sqrt:ident, $pow:ident) => {
        impl Scalar for $float {
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation)]
            fn from_f64(value: f64) -> Self {
                value as $float
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                #[cfg(feature = "std")]
                return $float::sin_cos(self);
                #[cfg(all(feature = "libm", not(feature = "std")))]
                return libm::$sincos(self);
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return $float::sqrt(self);
                #[cfg(all(feature = "libm", not(feature = "std")))]
                return libm::$sqrt(self);
            }
        }

        impl Real for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const EPSILON: Self = $float::EPSILON;
            const NAN: Self = $float::NAN;

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }

            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                #[cfg(feature = "std")]
                return $float::powf(self, exponent);
                #[cfg(all(feature = "libm", not(feature = "std")))]
                return libm::$pow(self, exponent);
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
        }
    };
}

implement_scalar!(f64, sincos, sqrt, pow);
implement_scalar!(f32, sincosf, sqrtf, powf);

#[cfg(test)]
mod tests {
    use super::{Real, Scalar};

    fn laws<T: Real>() {
        let angle = T::from_f64(0.7);
        let (sine, cosine) = Scalar::sin_cos(angle);
        let defect = sine * sine + cosine * cosine - T::ONE;
        assert!(Real::abs(defect) <= T::EPSILON + T::EPSILON);
        let two = T::ONE + T::ONE;
        assert_eq!(Scalar::sqrt(two * two), two);
        assert_eq!(Real::powf(two, two), two * two);
        assert!(!Real::is_finite(T::ONE / T::ZERO));
        assert!(Real::is_finite(T::ONE));
        assert!(T::ONE + T::EPSILON > T::ONE);
        assert_eq!(Real::to_f64(two), 2.0);
    }

    #[test]
    fn f64_and_f32_obey_the_same_laws() {
        laws::<f64>();
        laws::<f32>();
    }

    #[test]
    fn constants_round_once_to_the_nearest_value() {
        // 0.1 is no f32: the nearest one must come out, not a truncation.
        assert_eq!(<f32 as Scalar>::from_f64(0.1), 0.1_f32);
        assert_eq!(<f64 as Scalar>::from_f64(0.1), 0.1_f64);
    }

    #[test]
    fn maximum_and_minimum_keep_self_beside_nan() {
        assert_eq!(Real::max(1.0_f64, f64::NAN), 1.0);
        assert_eq!(Real::min(1.0_f64, f64::NAN), 1.0);
        assert_eq!(Real::max(1.0_f64, 2.0), 2.0);
        assert_eq!(Real::min(1.0_f64, 2.0), 1.0);
    }
}
