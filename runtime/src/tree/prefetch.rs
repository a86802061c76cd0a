//! Numbers that will be read soon.

#![allow(unsafe_code)]

/// Asks the memory for the line of a number, to be in the second cache when it is
/// used. A processor sees the pattern of a block, short strips far from each other,
/// too late.
#[inline(always)]
pub(super) fn prefetch<T>(place: *const T) {
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    // SAFETY: a hint, for which any address will do. It belongs to SSE, which this build has.
    unsafe {
        use core::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T1>(place.cast());
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
    let _ = place;
}
