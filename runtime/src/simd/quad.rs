//! Groups of four numbers: the memory layout of the Taylor recurrences.

use crate::scalar::Scalar;

/// Four consecutive numbers in memory, aligned for vector instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Quad<T>(
    /// The four numbers.
    pub [T; 4],
);

impl<T: Scalar> Quad<T> {
    /// Returns four copies of a number.
    #[inline(always)]
    #[must_use]
    pub fn splat(value: T) -> Self {
        Self([value; 4])
    }
}
