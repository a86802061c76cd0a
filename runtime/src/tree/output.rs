//! Where an evaluation writes.

#![allow(unsafe_code)]

use crate::simd::Simd;

/// Where accelerations go.
pub(super) trait Output<T> {
    /// Takes the accelerations of `count` links from the one with number `at` in the
    /// tree on: as many as `V` has lanes, or the first of these.
    ///
    /// # Safety
    /// The links are within reach of the strips of the block that is being computed.
    unsafe fn write<V: Simd<T>>(&mut self, at: usize, alpha: V, count: usize);
}
