//! Several numbers in lockstep.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::kind::{ByKind, Compiled};
use super::{Real, Scalar};
use crate::simd::Simd;

/// A number type of which vector registers exist: `f64` or `f32`. Sealed: other crates cannot
/// implement it.
// The trait is private on purpose: if it were `pub`, `T::Avx512` would give everybody with a `T:
// Lane` a register, on any machine.
#[allow(private_bounds)]
pub trait Lane: Registers {}

/// Vector registers of a plain number type, and functions compiled in this crate.
pub(crate) trait Registers: Real {
    /// Register of the build's instructions.
    type Build: Simd<Self>;
    /// Register of AVX2.
    type Avx2: Simd<Self>;
    /// Register of AVX-512.
    type Avx512: Simd<Self>;
    /// A single number that fuses.
    type Fused: Simd<Self>;
    /// Four numbers, computed with instructions of AVX2 if available.
    type Four: Simd<Self>;

    /// Returns a function for this number type that is compiled in this crate.
    fn compiled<C: Compiled>() -> C::Function<Self>;
}

/// `N` numbers that undergo the same operations: one evaluation of emitted code then evaluates `N`
/// states.
///
/// It is a plain array with loops over it, which the compiler turns into vector instructions in
/// short functions. It works for any emitted function, with the instructions for which the program
/// is compiled. Each lane of a result has the same bits as the computation with a single number.
/// For the accelerations of many states use a [`Batch`](crate::batch::Batch), which needs no model
/// in lanes and chooses registers at run time.
///
/// # Examples
///
/// ```
/// use branched_pendulum::scalar::{Lanes, Scalar};
///
/// let angles = Lanes([0.0, 0.5, 1.0, 1.5_f64]);
/// let (sines, cosines) = angles.sin_cos();
/// assert_eq!((sines.0[2], cosines.0[2]), Scalar::sin_cos(1.0_f64));
/// assert_eq!((angles * Lanes::splat(2.0)).0, [0.0, 1.0, 2.0, 3.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes<T, const N: usize>(
    /// Numbers in the lanes.
    pub [T; N],
);

impl<T: Copy, const N: usize> Lanes<T, N> {
    /// Returns the same value in every lane.
    #[inline(always)]
    #[must_use]
    pub const fn splat(value: T) -> Self {
        Self([value; N])
    }
}

macro_rules! lane_by_lane {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl<T: Scalar, const N: usize> $trait for Lanes<T, N> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                let mut result = self;
                for i in 0..N {
                    result.0[i] = self.0[i] $operator other.0[i];
                }
                result
            }
        }
    };
}

lane_by_lane!(Add, add, +);
lane_by_lane!(Sub, sub, -);
lane_by_lane!(Mul, mul, *);
lane_by_lane!(Div, div, /);

impl<T: Scalar, const N: usize> Neg for Lanes<T, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let mut result = self;
        for i in 0..N {
            result.0[i] = -self.0[i];
        }
        result
    }
}

impl<T: Scalar, const N: usize> Scalar for Lanes<T, N> {
    #[inline(always)]
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<T>()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::splat(T::from_f64(value))
    }

    #[inline(always)]
    fn from_parts(high: f64, low: f64) -> Self {
        Self::splat(T::from_parts(high, low))
    }

    #[inline(always)]
    fn mul_add(mut self, factor: Self, addend: Self) -> Self {
        for i in 0..N {
            self.0[i] = self.0[i].mul_add(factor.0[i], addend.0[i]);
        }
        self
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sines, cosines) = T::sin_cos_each(&self.0);
        (Self(sines), Self(cosines))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let mut result = self;
        for i in 0..N {
            result.0[i] = self.0[i].sqrt();
        }
        result
    }
}
