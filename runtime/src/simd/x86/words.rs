//! Functions that permute a register's words, or write only its first numbers. The standard library
//! has no common names for these instructions.

use core::arch::x86_64::*;

/// Permutes the words of a register on machines that have no instruction for it.
#[inline(always)]
pub(super) unsafe fn words_of_sse2<V>(vector: V, words: &[u32; 4]) -> V {
    // SAFETY: the caller's vector has 128 bits, and all bit patterns are four valid words.
    let own: [u32; 4] = unsafe { core::mem::transmute_copy(&vector) };
    let result = words.map(|word| own[word as usize % 4]);
    // SAFETY: four words are 128 bits, and all bit patterns are valid numbers.
    unsafe { core::mem::transmute_copy(&result) }
}

#[inline(always)]
pub(super) unsafe fn words_of_avx2<V>(vector: V, words: &[u32; 8]) -> V {
    // SAFETY: the caller's vector has 256 bits.
    unsafe {
        let own = core::mem::transmute_copy(&vector);
        let words = core::mem::transmute::<[u32; 8], __m256i>(*words);
        core::mem::transmute_copy(&_mm256_permutevar8x32_epi32(own, words))
    }
}

#[inline(always)]
pub(super) unsafe fn words_of_avx512<V>(vector: V, words: &[u32; 16]) -> V {
    // SAFETY: the caller's vector has 512 bits.
    unsafe {
        let own = core::mem::transmute_copy(&vector);
        let words = core::mem::transmute::<[u32; 16], __m512i>(*words);
        core::mem::transmute_copy(&_mm512_permutexvar_epi32(words, own))
    }
}

/// Writes the first `count` numbers to `start`.
///
/// # Safety
/// `count` numbers must be writable there.
#[inline(always)]
pub(super) unsafe fn masked_f64(vector: __m512d, start: *mut f64, count: usize) {
    let mask = !((0xff_u32 << count.min(8)) as u8);
    // SAFETY: guaranteed by the caller: only the masked numbers are written.
    unsafe { _mm512_mask_storeu_pd(start, mask, vector) }
}

/// Writes the first `count` numbers to `start`.
///
/// # Safety
/// `count` numbers must be writable there.
#[inline(always)]
pub(super) unsafe fn masked_f32(vector: __m512, start: *mut f32, count: usize) {
    let mask = !((0xffff_u32 << count.min(16)) as u16);
    // SAFETY: guaranteed by the caller: only the masked numbers are written.
    unsafe { _mm512_mask_storeu_ps(start, mask, vector) }
}
