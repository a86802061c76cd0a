//! Parts of emitted functions that are too long to be one.

use super::dispatch::Kernel;

/// A part of an emitted function that is too long to be one.
#[doc(hidden)]
pub trait Part<const NUMBER: usize, A> {
    /// The values that the part hands on.
    type Output;

    /// Computes it.
    fn part(&self, arguments: A) -> Self::Output;
}

/// A [`Part`] with what it gets.
pub(crate) struct PartOf<'a, const NUMBER: usize, M, A> {
    pub(crate) model: &'a M,
    pub(crate) arguments: A,
}

impl<const NUMBER: usize, A, M: Part<NUMBER, A>> Kernel for PartOf<'_, NUMBER, M, A> {
    type Output = M::Output;

    #[inline(always)]
    fn run(self) -> M::Output {
        self.model.part(self.arguments)
    }
}
