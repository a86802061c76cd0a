//! Four numbers side by side: memory of the recurrences.

use crate::scalar::Scalar;

/// Four numbers side by side in memory, aligned as vector instructions like it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Quad<T>(
    /// The numbers.
    pub [T; 4],
);

impl<T: Scalar> Quad<T> {
    /// One number four times.
    #[inline(always)]
    #[must_use]
    pub fn splat(value: T) -> Self {
        Self([value; 4])
    }
}
