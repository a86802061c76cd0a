//! Prefetching of numbers that will be read soon.

#![allow(unsafe_code)]

/// Prefetches the cache line that contains a number into the second-level cache. The processor
/// alone recognises the access pattern of a block (short strips, far from each other) too late.
#[inline(always)]
pub(super) fn prefetch<T>(place: *const T) {
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    // SAFETY: prefetching is a hint and accepts any address. The instruction belongs to SSE, which
    // this build has.
    unsafe {
        use core::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T1>(place.cast());
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
    let _ = place;
}
