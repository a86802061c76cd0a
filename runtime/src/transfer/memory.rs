//! Memory of an evaluation, in parts.

use crate::scalar::Scalar;

/// What is left of a workspace's numbers.
pub(super) struct FreeMemory<'w, T>(pub(super) &'w mut [T]);

impl<'w, T: Scalar> FreeMemory<'w, T> {
    /// Takes so many numbers, of any values; fewer where there are no more.
    #[inline(always)]
    pub(super) fn take(&mut self, length: usize) -> &'w mut [T] {
        let all = core::mem::take(&mut self.0);
        let (part, rest) = all.split_at_mut(length.min(all.len()));
        self.0 = rest;
        part
    }

    /// Lends all numbers.
    #[inline(always)]
    pub(super) fn lend(&mut self) -> FreeMemory<'_, T> {
        FreeMemory(&mut *self.0)
    }
}
