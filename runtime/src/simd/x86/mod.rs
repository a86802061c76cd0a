//! Registers of x86-64: SSE2, AVX2 with FMA, AVX-512.
//!
//! This module contains the types and their common operations. Fusing and sines are in [`plain`]
//! for SSE2 and in [`fused`] for the others.

#![allow(unsafe_code)]

mod fused;
mod plain;
mod words;

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::permutation::{first_lanes, rotated, tiled};
use super::{Fused, Kernel, Sealed, Simd, dispatch};
use crate::scalar::sincos::fused as fused_sines;
use words::{masked_f32, masked_f64, words_of_avx2, words_of_avx512, words_of_sse2};

// For all calls of instructions here and in the two files: builds with SSE2 alone contain this
// module. The wider types are named only by computations that `dispatch` has started, after it has
// detected the instructions, and other crates cannot reach them (see `simd`). None of these
// instructions accesses memory. The types hold exactly the given numbers, in order and without
// padding, so that the transmutations are valid.

/// Defines when sines are computed (ahead or when needed), and separate functions, for registers
/// with fused multiply–add; other registers have the defaults.
macro_rules! ahead {
    () => {};
    ($lane:ident, $own:ident) => {
        const AHEAD: bool = true;

        #[inline(always)]
        fn sin_cos_ahead<const N: usize>(angles: &[Self; N]) -> Option<([Self; N], [Self; N])> {
            fused_sines::ahead(angles)
        }

        #[inline(always)]
        fn sin_cos_near<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
            fused_sines::near(angles)
        }

        #[inline(always)]
        fn in_own_function<K: Kernel<$lane>>(kernel: K) -> K::Output {
            dispatch::$own::<$lane, Self, K>(kernel)
        }
    };
}

/// Returns the larger magnitude: the larger number after the signs are cleared, or by the single
/// instruction that AVX-512 has for it.
macro_rules! larger {
    (_mm512_range_pd, $andnot:ident, $one:ident, $other:ident) => {
        // SAFETY: a register exists only on machines that have its instructions.
        Self(unsafe { _mm512_range_pd::<LARGER_SIZE>($one.0, $other.0) })
    };
    (_mm512_range_ps, $andnot:ident, $one:ident, $other:ident) => {
        // SAFETY: a register exists only on machines that have its instructions.
        Self(unsafe { _mm512_range_ps::<LARGER_SIZE>($one.0, $other.0) })
    };
    ($max:ident, $andnot:ident, $one:ident, $other:ident) => {{
        let sign = Self::splat(-0.0).0;
        // SAFETY: a register exists only on machines that have its instructions.
        Self(unsafe { $max($andnot(sign, $one.0), $andnot(sign, $other.0)) })
    }};
}

/// Mode of the instruction `range` that selects the operand of larger magnitude, without its sign.
const LARGER_SIZE: i32 = 0b1011;

macro_rules! register {
    (
        $(#[$docs:meta])*
        $name:ident: $vector:ident = $lanes:literal of $lane:ident, one: $one:ty,
        $splat:ident, $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident,
        $and:ident, $andnot:ident, $or:ident, larger: $larger:ident,
        words: $words:ident = $count:literal $(, some: $some:ident)? $(, fused: $own:ident)?
    ) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub(crate) struct $name(pub(crate) $vector);

        register!($name, Add, add, $add);
        register!($name, Sub, sub, $sub);
        register!($name, Mul, mul, $mul);
        register!($name, Div, div, $div);

        impl Neg for $name {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                // The compiler recognises this as a change of sign.
                Self::splat(-0.0) - self
            }
        }

        impl $name {
            #[inline(always)]
            pub(crate) fn from_array(numbers: [$lane; $lanes]) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { core::mem::transmute::<[$lane; $lanes], $vector>(numbers) })
            }

            #[inline(always)]
            pub(crate) fn to_array(self) -> [$lane; $lanes] {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe { core::mem::transmute::<$vector, [$lane; $lanes]>(self.0) }
            }

            /// Returns a register whose 32-bit word number `i` is word number `words[i]` of this
            /// one.
            #[inline(always)]
            pub(crate) fn permuted(self, words: &[u32; $count]) -> Self {
                // SAFETY: the register exists only on machines that have its instructions, and has
                // exactly these words.
                Self(unsafe { $words(self.0, words) })
            }

            #[inline(always)]
            fn root(self) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $sqrt(self.0) })
            }
        }

        impl Sealed<$lane> for $name {}

        impl Simd<$lane> for $name {
            type One = $one;
            /// Mask of lanes: in each lane, all bits are set or none.
            type Mask = Self;
            type Chunk = [$lane; $lanes];

            ahead!($($lane, $own)?);

            #[inline(always)]
            fn mask(meant: impl Fn(usize) -> bool) -> Self {
                Self::from_array(core::array::from_fn(|lane| {
                    $lane::from_bits(if meant(lane) { !0 } else { 0 })
                }))
            }

            #[inline(always)]
            fn choose(self, other: Self, mask: Self) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $or($and(mask.0, self.0), $andnot(mask.0, other.0)) })
            }

            #[inline(always)]
            fn in_first_lanes(self, count: usize, other: Self) -> Self {
                static MASKS: [[u32; $count]; $lanes] = first_lanes();
                match MASKS.get(count) {
                    Some(mask) => {
                        // SAFETY: the sizes are equal, and all bit patterns are valid numbers.
                        let mask = Self(unsafe {
                            core::mem::transmute::<[u32; $count], $vector>(*mask)
                        });
                        Simd::<$lane>::choose(self, other, mask)
                    }
                    None => self,
                }
            }

            #[inline(always)]
            fn larger_size(self, other: Self) -> Self {
                larger!($larger, $andnot, self, other)
            }

            #[inline(always)]
            fn splat(value: $lane) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $splat(value) })
            }

            $(
                #[inline(always)]
                unsafe fn write_some(self, start: *mut $lane, count: usize) {
                    // SAFETY: guaranteed by the caller.
                    unsafe { $some(self.0, start, count) }
                }
            )?

            #[inline(always)]
            fn rotate_lanes(self, first: usize) -> Self {
                static WORDS: [[u32; $count]; $lanes] = rotated();
                self.permuted(&WORDS[first % $lanes])
            }

            #[inline(always)]
            fn tile_lanes(self, count: usize) -> Self {
                static WORDS: [[u32; $count]; $lanes] = tiled();
                self.permuted(&WORDS[count.wrapping_sub(1) % $lanes])
            }
        }
    };
    ($name:ident, $trait:ident, $function:ident, $instruction:ident) => {
        impl $trait for $name {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

register! {
    /// SSE2 register of two `f64`.
    F64x2: __m128d = 2 of f64, one: f64,
    _mm_set1_pd, _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd, _mm_sqrt_pd,
    _mm_and_pd, _mm_andnot_pd, _mm_or_pd, larger: _mm_max_pd,
    words: words_of_sse2 = 4
}

register! {
    /// SSE2 register of four `f32`.
    F32x4: __m128 = 4 of f32, one: f32,
    _mm_set1_ps, _mm_add_ps, _mm_sub_ps, _mm_mul_ps, _mm_div_ps, _mm_sqrt_ps,
    _mm_and_ps, _mm_andnot_ps, _mm_or_ps, larger: _mm_max_ps,
    words: words_of_sse2 = 4
}

register! {
    /// AVX2 register of four `f64`.
    F64x4: __m256d = 4 of f64, one: Fused<f64>,
    _mm256_set1_pd, _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd,
    _mm256_and_pd, _mm256_andnot_pd, _mm256_or_pd, larger: _mm256_max_pd,
    words: words_of_avx2 = 8, fused: outlined_avx2
}

register! {
    /// AVX2 register of eight `f32`.
    F32x8: __m256 = 8 of f32, one: Fused<f32>,
    _mm256_set1_ps, _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps, _mm256_sqrt_ps,
    _mm256_and_ps, _mm256_andnot_ps, _mm256_or_ps, larger: _mm256_max_ps,
    words: words_of_avx2 = 8, fused: outlined_avx2
}

register! {
    /// AVX-512 register of eight `f64`.
    F64x8: __m512d = 8 of f64, one: Fused<f64>,
    _mm512_set1_pd, _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_sqrt_pd,
    _mm512_and_pd, _mm512_andnot_pd, _mm512_or_pd, larger: _mm512_range_pd,
    words: words_of_avx512 = 16, some: masked_f64, fused: outlined_avx512
}

register! {
    /// AVX-512 register of sixteen `f32`.
    F32x16: __m512 = 16 of f32, one: Fused<f32>,
    _mm512_set1_ps, _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps, _mm512_div_ps, _mm512_sqrt_ps,
    _mm512_and_ps, _mm512_andnot_ps, _mm512_or_ps, larger: _mm512_range_ps,
    words: words_of_avx512 = 16, some: masked_f32, fused: outlined_avx512
}
