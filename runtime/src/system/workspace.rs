//! Memory that evaluations need, kept by whoever asks for them.

use alloc::boxed::Box;
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
    /// For what is evaluated with these numbers.
    inner: Option<Box<Workspace<T>>>,
}

impl<T: Scalar> Workspace<T> {
    /// An empty workspace. Allocates nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            numbers: Vec::new(),
            inner: None,
        }
    }

    /// Returns the first `length` numbers, whose values are left open.
    #[inline]
    pub(crate) fn numbers(&mut self, length: usize) -> &mut [T] {
        first(&mut self.numbers, length)
    }

    /// Returns the first `length` numbers, and another workspace.
    #[doc(hidden)]
    pub fn with_inner(&mut self, length: usize) -> (&mut [T], &mut Self) {
        let numbers = first(&mut self.numbers, length);
        (numbers, self.inner.get_or_insert_default())
    }
}

impl<T: Scalar> Default for Workspace<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// Returns the first `length` numbers, of which there are so many then.
#[inline]
fn first<T: Scalar>(numbers: &mut Vec<T>, length: usize) -> &mut [T] {
    if numbers.len() < length {
        numbers.resize(length, T::from_f64(0.0));
    }
    numbers.get_mut(..length).unwrap_or_default()
}
