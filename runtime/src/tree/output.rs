//! Destinations to which an evaluation writes accelerations.

#![allow(unsafe_code)]

use crate::simd::Simd;

/// Destination of accelerations.
pub(super) trait Output<T> {
    /// Writes the accelerations of `count` links from index `at` of the tree on; `count` is at most
    /// the number of lanes of `V`.
    ///
    /// # Safety
    /// The links must belong to the strips of the block that is being computed.
    unsafe fn write<V: Simd<T>>(&mut self, at: usize, alpha: V, count: usize);
}
