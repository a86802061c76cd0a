//! Memory for evaluations, which the caller keeps.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::scalar::Scalar;

/// Memory for evaluations of one system at a time.
///
/// Models with unrolled code need none. Trees computed in loops need some numbers per link: the
/// first evaluation with a workspace allocates them, later ones allocate nothing. One workspace can
/// be used for any number of models, one after the other; each thread needs its own. Integrators
/// keep their own.
#[derive(Clone, Debug)]
pub struct Workspace<T> {
    numbers: Vec<T>,
    /// Inner workspace, for an evaluation that runs while the numbers of this one are in use.
    inner: Option<Box<Workspace<T>>>,
}

impl<T: Scalar> Workspace<T> {
    /// Creates an empty workspace. Allocates nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            numbers: Vec::new(),
            inner: None,
        }
    }

    /// Returns the first `length` numbers of the workspace, with arbitrary contents.
    #[inline]
    pub(crate) fn numbers(&mut self, length: usize) -> &mut [T] {
        first(&mut self.numbers, length)
    }

    /// Returns the first `length` numbers, with arbitrary contents, and an inner workspace for
    /// another evaluation.
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

/// Returns the first `length` numbers of a vector, after extending it if it is shorter.
#[inline]
fn first<T: Scalar>(numbers: &mut Vec<T>, length: usize) -> &mut [T] {
    if numbers.len() < length {
        numbers.resize(length, T::from_f64(0.0));
    }
    numbers.get_mut(..length).unwrap_or_default()
}
