//! Parts of functions that are too long to be one.

use super::{Kernel, Simd};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;

/// A part of an emitted function that is too long to be one.
#[doc(hidden)]
pub trait Part<const NUMBER: usize, A> {
    /// The values that the part hands on.
    type Output;

    /// Computes it.
    fn part(&self, arguments: A) -> Self::Output;
}

/// Computes a part in a function of its own, which is compiled for the instructions
/// that the number `S` stands for.
#[doc(hidden)]
#[inline(always)]
pub fn outlined<const NUMBER: usize, S, A, M>(model: &M, arguments: A) -> M::Output
where
    S: Scalar,
    M: Part<NUMBER, A>,
{
    S::by_kind(PartOf { model, arguments })
}

/// A [`Part`] with what it gets.
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
