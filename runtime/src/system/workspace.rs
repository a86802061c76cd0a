//! Memory that evaluations need, kept by whoever asks for them.

use alloc::vec::Vec;

use crate::scalar::Scalar;

/// Memory for evaluations of one system at a time.
///
/// Models written out link by link need none. Trees in loops need some numbers
/// for each link: the first evaluation with a workspace allocates them, later ones
/// allocate nothing. One workspace serves any number of models, one after the
/// other; several threads take one each. Integrators keep their own.
#[derive(Clone, Debug)]
pub struct Workspace<T> {
    numbers: Vec<T>,
}

impl<T: Scalar> Workspace<T> {
    /// An empty workspace. Allocates nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            numbers: Vec::new(),
        }
    }

    /// Returns the first `length` numbers, whose values are left open.
    #[inline]
    pub(crate) fn numbers(&mut self, length: usize) -> &mut [T] {
        if self.numbers.len() < length {
            self.numbers.resize(length, T::from_f64(0.0));
        }
        self.numbers.get_mut(..length).unwrap_or_default()
    }
}

impl<T: Scalar> Default for Workspace<T> {
    fn default() -> Self {
        Self::new()
    }
}
