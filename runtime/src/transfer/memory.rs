//! Workspace of an evaluation, from which consecutive parts are taken.

use crate::scalar::Scalar;

/// Remaining part of a workspace.
pub(super) struct FreeMemory<'w, T>(pub(super) &'w mut [T]);

impl<'w, T: Scalar> FreeMemory<'w, T> {
    /// Takes the next `length` numbers of the workspace, with arbitrary values; fewer if it is
    /// exhausted.
    #[inline(always)]
    pub(super) fn take(&mut self, length: usize) -> &'w mut [T] {
        let all = core::mem::take(&mut self.0);
        let (part, rest) = all.split_at_mut(length.min(all.len()));
        self.0 = rest;
        part
    }

    /// Lends the remaining workspace.
    #[inline(always)]
    pub(super) fn lend(&mut self) -> FreeMemory<'_, T> {
        FreeMemory(&mut *self.0)
    }
}
