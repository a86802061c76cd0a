//! Registers of AVX2 and AVX-512 with fused multiply–add, and the sines that use them.

use core::arch::x86_64::*;

use super::super::Simd;
use super::{F32x8, F32x16, F64x4, F64x8};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::scalar::sincos::{double, fused};

macro_rules! fused {
    ($name:ident: $lane:ident, $fused:ident) => {
        impl Scalar for $name {
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                <Self as Simd<$lane>>::splat(<$lane as Scalar>::from_f64(value))
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $fused(self.0, factor.0, addend.0) })
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let ([sine], [cosine]) = Self::sin_cos_each(&[self]);
                (sine, cosine)
            }

            #[inline(always)]
            fn sin_cos_each<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
                fused::each(angles)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.root()
            }

            #[inline(always)]
            fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
                question.of_wide::<$lane>()
            }
        }
    };
}

fused!(F64x4: f64, _mm256_fmadd_pd);
fused!(F32x8: f32, _mm256_fmadd_ps);
fused!(F64x8: f64, _mm512_fmadd_pd);
fused!(F32x16: f32, _mm512_fmadd_ps);

/// Arithmetic of plain numbers, without fused multiply–add.
impl double::UnfusedNumber for F64x4 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        <Self as Simd<f64>>::splat(value)
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: a register exists only on machines that have its instructions.
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            let quarter = _mm256_castpd_si256(quarter.0);
            let next = _mm256_add_epi64(quarter, _mm256_set1_epi64x(1));
            // Blend instructions read the highest bit of each lane.
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(quarter));
            let sine_signs = _mm256_castsi256_pd(_mm256_slli_epi64::<62>(quarter));
            let cosine_signs = _mm256_castsi256_pd(_mm256_slli_epi64::<62>(next));
            let turned_sine = _mm256_blendv_pd(sine.0, cosine.0, odd);
            let turned_cosine = _mm256_blendv_pd(cosine.0, sine.0, odd);
            (
                Self(_mm256_xor_pd(turned_sine, _mm256_and_pd(sign, sine_signs))),
                Self(_mm256_xor_pd(
                    turned_cosine,
                    _mm256_and_pd(sign, cosine_signs),
                )),
            )
        }
    }
}

/// Implements [`fused::FusingNumber`] for registers of AVX2.
macro_rules! avx2 {
    (
        $name:ident = $lanes:literal of $lane:ident, $splat:ident,
        $integers:ident, $numbers:ident, $shift:ident by $parity:literal and $sign:literal,
        $and:ident, $or:ident, $xor:ident, $blend:ident, $compare:ident, $mask:ident
    ) => {
        impl fused::FusingNumber for $name {
            type Lane = $lane;
            type Array = [$lane; $lanes];

            #[inline(always)]
            fn exchange(quarter: Self, high: Self, lost: Self, cosine: Self) -> (Self, Self) {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe {
                    let quarter = $integers(quarter.0);
                    // Blend instructions read the highest bit of each lane.
                    let odd = $numbers($shift::<$parity>(quarter));
                    let signs = $and($splat(-0.0), $numbers($shift::<$sign>(quarter)));
                    let sine = $blend((high - lost).0, cosine.0, odd);
                    let cosine = $blend(cosine.0, (lost - high).0, odd);
                    (Self($xor(sine, signs)), Self($xor(cosine, signs)))
                }
            }

            #[inline(always)]
            fn or_differing(self, one: Self, other: Self) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $or(self.0, $xor(one.0, other.0)) })
            }

            #[inline(always)]
            fn only_low_bits(self) -> bool {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe {
                    _mm256_testz_si256(
                        $integers(self.0),
                        $integers($splat(<$lane as fused::Float>::HIGH_BITS)),
                    ) == 1
                }
            }

            #[inline(always)]
            fn all_below(self, limit: $lane) -> bool {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe {
                    let below = $compare::<_CMP_LT_OQ>(self.0, $splat(limit));
                    $mask(below) == (1 << $lanes) - 1
                }
            }

            #[inline(always)]
            fn from_numbers(numbers: Self::Array) -> Self {
                Self::from_array(numbers)
            }

            #[inline(always)]
            fn to_numbers(self) -> Self::Array {
                self.to_array()
            }
        }
    };
}

avx2! {
    F64x4 = 4 of f64, _mm256_set1_pd,
    _mm256_castpd_si256, _mm256_castsi256_pd, _mm256_slli_epi64 by 63 and 62,
    _mm256_and_pd, _mm256_or_pd, _mm256_xor_pd, _mm256_blendv_pd, _mm256_cmp_pd, _mm256_movemask_pd
}

avx2! {
    F32x8 = 8 of f32, _mm256_set1_ps,
    _mm256_castps_si256, _mm256_castsi256_ps, _mm256_slli_epi32 by 31 and 30,
    _mm256_and_ps, _mm256_or_ps, _mm256_xor_ps, _mm256_blendv_ps, _mm256_cmp_ps, _mm256_movemask_ps
}

/// Truth table, for the ternary logic instruction, of a ⊕ (b ∧ c), bit by bit.
const XOR_AND: i32 = 0x78;

/// Implements [`fused::FusingNumber`] for registers of AVX-512.
macro_rules! avx512 {
    (
        $name:ident = $lanes:literal of $lane:ident, $splat:ident, $integer:ident,
        $integers:ident, $numbers:ident, $shift:ident by $sign:literal, $test:ident,
        $ternary:ident, $or:ident, $xor:ident, $choose:ident, $compare:ident
    ) => {
        impl fused::FusingNumber for $name {
            type Lane = $lane;
            type Array = [$lane; $lanes];

            #[inline(always)]
            fn exchange(quarter: Self, high: Self, lost: Self, cosine: Self) -> (Self, Self) {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe {
                    let sign = $integers($splat(-0.0));
                    let quarter = $integers(quarter.0);
                    // Writing a mask takes as long as a product, so both results use one mask. A
                    // masked sum takes half as long as a sum and a masked copy.
                    let odd = $test(quarter, $integer(1));
                    let signs = $shift::<$sign>(quarter);
                    let sine = $integers($choose((high - lost).0, odd, cosine.0));
                    let cosine = $integers($choose(cosine.0, odd, (lost - high).0));
                    (
                        Self($numbers($ternary::<XOR_AND>(sine, signs, sign))),
                        Self($numbers($ternary::<XOR_AND>(cosine, signs, sign))),
                    )
                }
            }

            #[inline(always)]
            fn or_differing(self, one: Self, other: Self) -> Self {
                // SAFETY: a register exists only on machines that have its instructions.
                Self(unsafe { $or(self.0, $xor(one.0, other.0)) })
            }

            #[inline(always)]
            fn only_low_bits(self) -> bool {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe {
                    let above = $splat(<$lane as fused::Float>::HIGH_BITS);
                    $test($integers(self.0), $integers(above)) == 0
                }
            }

            #[inline(always)]
            fn all_below(self, limit: $lane) -> bool {
                // SAFETY: a register exists only on machines that have its instructions.
                unsafe { $compare::<_CMP_LT_OQ>(self.0, $splat(limit)) == !0 }
            }

            #[inline(always)]
            fn from_numbers(numbers: Self::Array) -> Self {
                Self::from_array(numbers)
            }

            #[inline(always)]
            fn to_numbers(self) -> Self::Array {
                self.to_array()
            }
        }
    };
}

avx512! {
    F64x8 = 8 of f64, _mm512_set1_pd, _mm512_set1_epi64,
    _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_slli_epi64 by 62, _mm512_test_epi64_mask,
    _mm512_ternarylogic_epi64, _mm512_or_pd, _mm512_xor_pd, _mm512_mask_mov_pd,
    _mm512_cmp_pd_mask
}

avx512! {
    F32x16 = 16 of f32, _mm512_set1_ps, _mm512_set1_epi32,
    _mm512_castps_si512, _mm512_castsi512_ps, _mm512_slli_epi32 by 30, _mm512_test_epi32_mask,
    _mm512_ternarylogic_epi32, _mm512_or_ps, _mm512_xor_ps, _mm512_mask_mov_ps,
    _mm512_cmp_ps_mask
}
