//! Parts of emitted functions that are too long to be compiled in one piece.

use super::{Kernel, Simd};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;

/// A part of an emitted function that is too long to be compiled in one piece.
#[doc(hidden)]
pub trait Part<const NUMBER: usize, A> {
    /// Values that the part returns.
    type Output;

    /// Computes the part.
    fn part(&self, arguments: A) -> Self::Output;
}

/// Computes a part in a separate function, which is compiled for the instructions of the number
/// type `S`.
#[doc(hidden)]
#[inline(always)]
pub fn outlined<const NUMBER: usize, S, A, M>(model: &M, arguments: A) -> M::Output
where
    S: Scalar,
    M: Part<NUMBER, A>,
{
    S::by_kind(PartOf { model, arguments })
}

/// A [`Part`] with its arguments.
struct PartOf<'a, const NUMBER: usize, M, A> {
    model: &'a M,
    arguments: A,
}

impl<S, const NUMBER: usize, A, M> ByKind<S> for PartOf<'_, NUMBER, M, A>
where
    S: Scalar,
    M: Part<NUMBER, A>,
{
    type Output = M::Output;

    #[inline(never)]
    fn of_any(self) -> M::Output {
        self.model.part(self.arguments)
    }

    #[inline(always)]
    fn of_wide<T: Scalar>(self) -> M::Output
    where
        S: Simd<T>,
    {
        S::in_own_function(self)
    }
}

impl<T, const NUMBER: usize, A, M: Part<NUMBER, A>> Kernel<T> for PartOf<'_, NUMBER, M, A> {
    type Output = M::Output;

    #[inline(always)]
    fn run<V: Simd<T>>(self) -> M::Output {
        self.model.part(self.arguments)
    }
}
