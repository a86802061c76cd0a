//! The numbers that emitted code and integrators compute with.
//!
//! Two traits, because two kinds of code ask for different things.
//! [`Scalar`] is what straight-line emitted code needs: arithmetic, sine and
//! cosine, square root. It has no ordering, so that SIMD lanes, dual numbers
//! and double-double numbers can implement it. [`Real`] adds what step-size
//! control needs: comparison, absolute value, a real power.
//!
//! | type | is | for |
//! |---|---|---|
//! | `f64`, `f32` | plain numbers | trajectories |
//! | [`Lanes`] | several of them in step, in vector registers | many states |
//! | [`Dual`] | a number and derivatives | Jacobians, variational equations |
//! | [`Double`] | 106 bits in two `f64` | references |
//!
//! Sines and cosines of `f64` and `f32` are this crate's own: faster than the
//! system's several at a time, equal in all types and on all machines to the
//! last bit, less than 0.9 units in the last place from the true value.

pub(crate) mod dispatch;
mod dual;
mod float;
mod lanes;
#[cfg(test)]
mod reference;
mod sincos;
mod wide;

pub use dispatch::InstructionSet;
pub use dual::Dual;
pub use lanes::{Lane, Lanes};
pub use wide::Double;

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::taylor::{Kernel, Quad};

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

    /// Sines and cosines of `N` angles in radians, in their order: the same
    /// values as [`sin_cos`](Self::sin_cos) of each, sooner where the type can
    /// compute several at once.
    #[inline(always)]
    fn sin_cos_each<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
        let zero = Self::from_f64(0.0);
        let (mut sines, mut cosines) = ([zero; N], [zero; N]);
        for i in 0..N {
            (sines[i], cosines[i]) = angles[i].sin_cos();
        }
        (sines, cosines)
    }

    /// Square root.
    fn sqrt(self) -> Self;

    /// Runs a computation of Taylor coefficients in the vector instructions
    /// that the machine has for this type.
    #[doc(hidden)]
    #[inline(always)]
    fn run_packs<K: Kernel<Self>>(kernel: K) {
        kernel.run::<Quad<Self>>();
    }
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
