//! Selection of code by the kind of number type: plain, wide, or any other.

// The traits occur in the interface of public ones, so that they must be `pub`; no other code names
// them.
#![allow(unreachable_pub)]

use core::marker::PhantomData;

use super::{Lane, Scalar};
use crate::simd::Simd;

/// A computation with separate versions for several kinds of numbers. [`Scalar::by_kind`] selects
/// the version.
pub trait ByKind<S: Scalar>: Sized {
    /// Result of the computation.
    type Output;

    /// Computes for numbers of any other kind.
    fn of_any(self) -> Self::Output;

    /// Computes for `f64` or `f32`.
    #[inline(always)]
    fn of_plain(self) -> Self::Output
    where
        S: Lane,
    {
        self.of_any()
    }

    /// Computes for a wide number, which consists of several plain ones, or for a number with fused
    /// multiply–add.
    #[inline(always)]
    fn of_wide<T: Scalar>(self) -> Self::Output
    where
        S: Simd<T>,
    {
        self.of_any()
    }
}

/// A generic function that is compiled once for `f64` and `f32` in this crate, and not in every
/// crate that calls it.
pub trait Compiled {
    /// Type of the function.
    type Function<T: Scalar>;

    /// Returns the function for number types of any kind.
    fn of_any<T: Scalar>() -> Self::Function<T>;

    /// Returns the function for `f64`.
    fn of_f64() -> Self::Function<f64>;

    /// Returns the function for `f32`.
    fn of_f32() -> Self::Function<f32>;
}

/// Implements [`Compiled`] for a new marker type that represents a function.
macro_rules! compiled_once {
    ($(#[$docs:meta])* $vis:vis $name:ident<$t:ident> = $function:path: $kind:ty) => {
        $(#[$docs])*
        $vis struct $name;

        impl $crate::scalar::kind::Compiled for $name {
            type Function<$t: Scalar> = $kind;

            #[inline(always)]
            fn of_any<$t: Scalar>() -> Self::Function<$t> {
                $function
            }

            // If they were inlined, they would be compiled in the calling crate.
            #[inline(never)]
            fn of_f64() -> Self::Function<f64> {
                $function
            }

            #[inline(never)]
            fn of_f32() -> Self::Function<f32> {
                $function
            }
        }
    };
}

pub(crate) use compiled_once;

/// Returns a function that is compiled for numbers of type `T`.
#[inline(always)]
pub(crate) fn compiled<C: Compiled, T: Scalar>() -> C::Function<T> {
    T::by_kind(FunctionOf::<C>(PhantomData))
}

/// Selects a function by the kind of number type.
struct FunctionOf<C>(PhantomData<C>);

impl<S: Scalar, C: Compiled> ByKind<S> for FunctionOf<C> {
    type Output = C::Function<S>;

    #[inline(always)]
    fn of_any(self) -> C::Function<S> {
        C::of_any()
    }

    #[inline(always)]
    fn of_plain(self) -> C::Function<S>
    where
        S: Lane,
    {
        S::compiled::<C>()
    }
}
