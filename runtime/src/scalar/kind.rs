//! Choices by the kind of a number: plain, wide, or any other.

// The traits appear in the interface of public ones, so that they must be `pub`, and
// are named by no one else.
#![allow(unreachable_pub)]

use core::marker::PhantomData;

use super::{Lane, Scalar};
use crate::simd::Simd;

/// A question that numbers of several kinds answer each in their own way. Numbers put
/// it to [`Scalar::by_kind`].
pub trait ByKind<S: Scalar>: Sized {
    /// The answer.
    type Output;

    /// Answers for a number of any kind.
    fn of_any(self) -> Self::Output;

    /// Answers for `f64` or `f32`.
    #[inline(always)]
    fn of_plain(self) -> Self::Output
    where
        S: Lane,
    {
        self.of_any()
    }

    /// Answers for a wide number of several plain ones, or for one that fuses.
    #[inline(always)]
    fn of_wide<T: Scalar>(self) -> Self::Output
    where
        S: Simd<T>,
    {
        self.of_any()
    }
}

/// A generic function that is compiled with this crate for `f64` and for `f32`, once,
/// and not with every crate that calls it.
pub trait Compiled {
    /// Type of the function.
    type Function<T: Scalar>;

    /// Returns it for any numbers.
    fn of_any<T: Scalar>() -> Self::Function<T>;

    /// Returns it for `f64`.
    fn of_f64() -> Self::Function<f64>;

    /// Returns it for `f32`.
    fn of_f32() -> Self::Function<f32>;
}

/// Implements [`Compiled`] for a new type that stands for a function.
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

            // Inlined, they would be compiled where they are called.
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

/// Returns a function for numbers `T`.
#[inline(always)]
pub(crate) fn compiled<C: Compiled, T: Scalar>() -> C::Function<T> {
    T::by_kind(FunctionOf::<C>(PhantomData))
}

/// Asks for a function.
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
