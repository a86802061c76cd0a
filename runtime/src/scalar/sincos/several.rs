//! Sine and cosine of several angles of plain numbers, in the widest registers of the machine.
//!
//! Narrow registers are filled in place. For wide ones a function is called, because only a
//! separate function can be compiled for other instructions than its surroundings. A wide load has
//! to wait for narrow stores just made to the same address: angles are therefore read in place,
//! never copied together first.

use super::{sin_cos_f32, sin_cos_f64};
use crate::simd::dispatch::run_wide;
use crate::simd::{InstructionSet, Kernel, Simd};

/// Computes the sines and cosines of `N` angles of type `f64`.
#[inline(always)]
pub(crate) fn several_f64<const N: usize>(angles: &[f64; N]) -> ([f64; N], [f64; N]) {
    match N {
        // For so few angles a call costs more than it saves.
        0..3 => sin_cos_f64(*angles),
        3..8 => few::sin_cos(angles),
        _ => run_wide(InstructionSet::widest(), Many(angles)),
    }
}

/// Computes the sines and cosines of `N` angles of type `f32`.
#[inline(always)]
pub(crate) fn several_f32<const N: usize>(angles: &[f32; N]) -> ([f32; N], [f32; N]) {
    if N < 8 {
        sin_cos_f32(*angles)
    } else {
        run_wide(InstructionSet::widest(), Many(angles))
    }
}

/// At least eight angles.
struct Many<'a, T, const N: usize>(&'a [T; N]);

macro_rules! eight_at_a_time {
    ($float:ident, $sin_cos:ident) => {
        impl<const N: usize> Kernel<$float> for Many<'_, $float, N> {
            type Output = ([$float; N], [$float; N]);

            /// Computes blocks of angles. If their number is not a multiple of eight, the last
            /// block overlaps the one before.
            #[inline(always)]
            fn run<V: Simd<$float>>(self) -> Self::Output {
                let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
                let mut start = 0;
                while start < N {
                    let first = start.min(N - 8);
                    let block = first..first + 8;
                    let mut angles = [0.0; 8];
                    angles.copy_from_slice(&self.0[block.clone()]);
                    let (block_sines, block_cosines) = $sin_cos(angles);
                    sines[block.clone()].copy_from_slice(&block_sines);
                    cosines[block].copy_from_slice(&block_cosines);
                    start += 8;
                }
                (sines, cosines)
            }
        }
    };
}

eight_at_a_time!(f64, sin_cos_f64);
eight_at_a_time!(f32, sin_cos_f32);

/// Three to seven angles.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[allow(unsafe_code)]
mod few {
    use super::super::quad::sin_cos_quad;
    use super::InstructionSet;
    use super::sin_cos_f64;

    #[inline(always)]
    pub(super) fn sin_cos<const N: usize>(angles: &[f64; N]) -> ([f64; N], [f64; N]) {
        if N > 4 {
            return in_blocks(angles);
        }
        // Whole registers are stored, because a load across two stores would have to wait.
        let (sines, cosines) = in_blocks::<N, 4>(angles);
        let first = |block: [f64; 4]| block.first_chunk::<N>().copied().unwrap_or([0.0; N]);
        (first(sines), first(cosines))
    }

    /// Computes the sines and cosines of `M` angles: all `N`, or one block.
    #[inline(always)]
    fn in_blocks<const N: usize, const M: usize>(angles: &[f64; N]) -> ([f64; M], [f64; M]) {
        match InstructionSet::widest() {
            InstructionSet::Build => build(angles),
            // SAFETY: `widest` has detected AVX2 and FMA.
            InstructionSet::Avx2 => unsafe { avx2(angles) },
            // SAFETY: `widest` has detected AVX-512.
            InstructionSet::Avx512 => unsafe { avx512(angles) },
        }
    }

    #[inline(never)]
    fn build<const N: usize, const M: usize>(angles: &[f64; N]) -> ([f64; M], [f64; M]) {
        sin_cos_f64(core::array::from_fn(|i| {
            angles.get(i).copied().unwrap_or(0.0)
        }))
    }

    #[target_feature(enable = "avx2,fma")]
    fn avx2<const N: usize, const M: usize>(angles: &[f64; N]) -> ([f64; M], [f64; M]) {
        quads(angles)
    }

    #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq")]
    fn avx512<const N: usize, const M: usize>(angles: &[f64; N]) -> ([f64; M], [f64; M]) {
        quads(angles)
    }

    /// Computes sines and cosines in blocks of four; the last block overlaps the one before.
    #[target_feature(enable = "avx2,fma")]
    #[inline]
    fn quads<const N: usize, const M: usize>(angles: &[f64; N]) -> ([f64; M], [f64; M]) {
        let (mut sines, mut cosines) = ([0.0; M], [0.0; M]);
        let mut start = 0;
        while start < M {
            let first = start.min(M - 4);
            let block = core::array::from_fn(|i| angles.get(first + i).copied().unwrap_or(0.0));
            let (block_sines, block_cosines) = sin_cos_quad(block);
            sines[first..first + 4].copy_from_slice(&block_sines);
            cosines[first..first + 4].copy_from_slice(&block_cosines);
            start += 4;
        }
        (sines, cosines)
    }
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
mod few {
    #[inline(always)]
    pub(super) fn sin_cos<const N: usize>(angles: &[f64; N]) -> ([f64; N], [f64; N]) {
        super::sin_cos_f64(*angles)
    }
}
