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
//! | [`PowerSeries`] | a number and powers of a small one | expansions |
//! | [`Double`] | 106 bits in two `f64` | references |
//!
//! Sines and cosines of `f64` and `f32` are this crate's own: faster than the
//! system's several at a time, less than 0.9 units in the last place from the true
//! value.
//!
//! # Which bits
//!
//! Emitted code says with [`Scalar::mul_add`] where a product and a sum may be one
//! operation, rounded once: wherever a product feeds nothing but sums, but never
//! in a difference of two products, which must vanish where they are equal. What
//! comes of it depends on the numbers that the code computes with:
//!
//! - `f64`, `f32`, [`Lanes`], [`Dual`] and [`Double`] do not fuse. A function of a
//!   model, such as its own `accelerations`, gives the same bits on every machine.
//! - [`Pendulum::accelerations_into`](crate::Pendulum::accelerations_into) of an
//!   emitted model in `f64` or `f32`, which integrators call, and
//!   [`Batch`](crate::batch::Batch) fuse on x86-64 machines with AVX2 and FMA, in
//!   builds with `std`. Both give equal bits to a state, alone or in a batch,
//!   with AVX2 or AVX-512: the same on every machine that has these, and other last
//!   bits than on those that do not. There, and for a batch with
//!   [`InstructionSet::Build`], the bits are those of the functions above.
//!
//! Sines and cosines follow: one angle has the same two values in all types that
//! do not fuse, and the same two in all that do.

mod dual;
mod float;
pub(crate) mod kind;
mod lanes;
mod power_series;
#[cfg(test)]
mod reference;
pub(crate) mod sincos;
mod turns;
mod wide;

pub use dual::Dual;
pub use lanes::{Lane, Lanes};
pub use power_series::PowerSeries;
pub use turns::Turns;
#[doc(hidden)]
pub(crate) use turns::at;
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
    + Send
    + Sync
    + 'static
{
    /// The value of this type nearest to `value`; for lanes, the same value in
    /// each. Used for constants, and for them only.
    fn from_f64(value: f64) -> Self;

    /// A constant given as the `f64` nearest to it and the `f64` nearest to
    /// the rest. Types of no more digits than `f64` take the first alone.
    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        let _ = low;
        Self::from_f64(high)
    }

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

    /// Answers a question of this crate that depends on the kind of number.
    #[doc(hidden)]
    #[inline(always)]
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_any()
    }

    /// `self * factor + addend`, fused where the type says so: rounded once then,
    /// and twice by default.
    ///
    /// `f64`, `f32` and [`Lanes`] do not fuse, so that they have the same bits on
    /// every machine. What [`Pendulum`](crate::Pendulum) and
    /// [`Batch`](crate::batch::Batch) compute with, where the machine has wider
    /// registers, does.
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
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

    /// Returns true if the value is neither infinite nor NaN.
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
