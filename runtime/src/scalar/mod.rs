//! Number types with which emitted code and integrators compute.
//!
//! There are two traits, because two kinds of code have different needs. [`Scalar`] is for
//! straight-line emitted code: arithmetic, sine and cosine, square root. It has no ordering, so
//! that SIMD lanes, dual numbers and double-double numbers can implement it. [`Real`] adds
//! comparison, absolute value and real powers for step-size control.
//!
//! | type | is | for |
//! |---|---|---|
//! | `f64`, `f32` | plain numbers | trajectories |
//! | [`Lanes`] | several of them in lockstep, in vector registers | many states |
//! | [`Dual`] | a number and derivatives | Jacobians, variational equations |
//! | [`PowerSeries`] | a number and powers of a small one | expansions |
//! | `Polynomial` | a truncated polynomial in many variables | normal forms |
//! | [`Double`] | 106 bits in two `f64` | references |
//!
//! Sines and cosines of `f64` and `f32` are computed by this crate: several at a time they are
//! faster than those of the system, with an error below 0.9 units in the last place.
//!
//! # Which bits
//!
//! Emitted code marks with [`Scalar::mul_add`] where a product and a sum may be fused to one
//! operation with a single rounding. This is the case if a product is used in sums only, but never
//! in a difference of two products, which must vanish if they are equal. The results depend on the
//! number type:
//!
//! - `f64`, `f32`, [`Lanes`], [`Dual`] and [`Double`] do not fuse. A function of a model, such as
//!   its own `accelerations`, returns the same bits on every machine.
//! - [`Pendulum::accelerations_into`](crate::Pendulum::accelerations_into) of an emitted model in
//!   `f64` or `f32`, which integrators call, and [`Batch`](crate::batch::Batch) fuse on x86-64
//!   machines with AVX2 and FMA, in builds with `std`. Both give a state the same bits, alone or in
//!   a batch, with AVX2 or AVX-512. These bits are the same on every machine with these
//!   instructions, and differ in the last places from those on other machines. On the latter, and
//!   for a batch with [`InstructionSet::Build`], the bits are those of the functions above.
//!
//! Sines and cosines follow this rule: an angle has the same two values in all types that do not
//! fuse, and the same two values in all types that do.

mod dual;
mod float;
pub(crate) mod kind;
mod lanes;
#[cfg(feature = "std")]
mod polynomial;
mod power_series;
#[cfg(test)]
mod reference;
mod sin_cos_pairs;
pub(crate) mod sincos;
mod wide;

pub use dual::Dual;
pub use lanes::{Lane, Lanes};
#[cfg(feature = "std")]
pub use polynomial::{Exponents, Polynomial, TermSum, Terms, Truncation};
pub use power_series::PowerSeries;
pub use sin_cos_pairs::SinCosPairs;
#[doc(hidden)]
pub(crate) use sin_cos_pairs::at;
pub use wide::Double;
pub(crate) use wide::two_sum;

pub use crate::simd::InstructionSet;

use core::fmt::{Debug, Display};
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use kind::ByKind;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "branched-pendulum needs sine, cosine and square root: \
     enable the feature `std`, or `libm` for targets without it"
);

/// A number with which emitted code can compute.
///
/// The trait has no comparisons: one body of emitted code works for plain numbers, SIMD lanes, dual
/// numbers and extended precision.
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
    + Send
    + Sync
    + 'static
{
    /// Returns the number of this type nearest to `value`; for lanes, the same number in each. It
    /// is used for constants only.
    fn from_f64(value: f64) -> Self;

    /// Returns a constant that is given as the nearest `f64` plus the `f64` nearest to the
    /// remainder. Types that have no more digits than `f64` use only the first.
    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        let _ = low;
        Self::from_f64(high)
    }

    /// Returns the sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// Returns the sines and cosines of `N` angles in radians, in order. The values are those of
    /// [`sin_cos`](Self::sin_cos), but are computed faster if the type can compute several at once.
    #[inline(always)]
    fn sin_cos_each<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
        let zero = Self::from_f64(0.0);
        let (mut sines, mut cosines) = ([zero; N], [zero; N]);
        for i in 0..N {
            (sines[i], cosines[i]) = angles[i].sin_cos();
        }
        (sines, cosines)
    }

    /// Returns the square root.
    fn sqrt(self) -> Self;

    /// Runs the version of a computation that is written for this kind of number.
    #[doc(hidden)]
    #[inline(always)]
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_any()
    }

    /// Returns `self * factor + addend`. Types with fused multiply–add round the result once; by
    /// default it is rounded twice.
    ///
    /// `f64`, `f32` and [`Lanes`] do not fuse here, so that results have the same bits on every
    /// machine. [`Pendulum`](crate::Pendulum) and [`Batch`](crate::batch::Batch) use number types
    /// that do, on machines that support it.
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
}

/// A real number with an order, as step-size control needs in addition to [`Scalar`].
pub trait Real: Scalar + PartialOrd + AddAssign + Display {
    /// The number zero.
    const ZERO: Self;
    /// The number one.
    const ONE: Self;
    /// Difference between one and the next larger number.
    const EPSILON: Self;
    /// Not a number: the result of an undefined operation.
    const NAN: Self;

    /// Returns the value as `f64`, rounded if the type has more digits.
    fn to_f64(self) -> f64;

    /// Returns the absolute value.
    fn abs(self) -> Self;

    /// Returns `self` to the power `exponent`, for `self >= 0`.
    fn powf(self, exponent: Self) -> Self;

    /// Returns true if the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Returns the larger of two numbers; `self` if either is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// Returns the smaller of two numbers; `self` if either is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}
