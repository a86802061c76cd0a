//! Registers of x86-64: SSE2, AVX2 with FMA, AVX-512.

#![allow(unsafe_code)]

use core::arch::x86_64::*;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::super::sincos::{double, fused, sin_cos_f32};
use super::super::{Scalar, dispatch};
use super::Register;
use crate::generations::With;
use crate::model::{Part, PartOf};

// SAFETY, for all calls of instructions below: those of SSE2 belong to every
// x86-64 machine. Values of the wider types arise in computations started by
// `dispatch` alone, which has asked the machine for the instructions; nothing
// public takes or gives them. None of these instructions touches memory. The
// types hold so many numbers of that size, in order and without padding, which
// makes the transmutations right.

macro_rules! register {
    (
        $(#[$docs:meta])*
        $name:ident: $vector:ident = $lanes:literal of $lane:ident,
        $splat:ident, $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident,
        $max:ident, $and:ident, $andnot:ident, $or:ident, $words:ident = $count:literal, $some:ident
    ) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub struct $name(pub(in crate::scalar) $vector);

        register!($name, Add, add, $add);
        register!($name, Sub, sub, $sub);
        register!($name, Mul, mul, $mul);
        register!($name, Div, div, $div);

        impl Neg for $name {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                // The compiler knows this as a change of sign.
                Self::splat(-0.0) - self
            }
        }

        impl $name {
            #[inline(always)]
            pub(crate) fn from_array(numbers: [$lane; $lanes]) -> Self {
                // SAFETY: see the top.
                Self(unsafe { core::mem::transmute::<[$lane; $lanes], $vector>(numbers) })
            }

            #[inline(always)]
            pub(crate) fn to_array(self) -> [$lane; $lanes] {
                // SAFETY: see the top.
                unsafe { core::mem::transmute::<$vector, [$lane; $lanes]>(self.0) }
            }

            /// The register whose word `i`, of 32 bits, is `words[i]` of this one.
            #[inline(always)]
            pub(crate) fn permuted(self, words: &[u32; $count]) -> Self {
                // SAFETY: see the top; and plain bits are as many.
                Self(unsafe { $words(self.0, words) })
            }

            /// Writes as many numbers as there are places.
            #[inline(always)]
            pub(crate) fn store_some(self, places: &mut [$lane]) {
                $some(self.0, self.to_array(), places);
            }

            #[inline(always)]
            fn root(self) -> Self {
                // SAFETY: see the top.
                Self(unsafe { $sqrt(self.0) })
            }
        }

        impl Register for $name {
            type Lane = $lane;
            type Vectors = With<Self>;
            /// All bits set, or none.
            type Mask = Self;

            const LANES: usize = $lanes;

            #[inline(always)]
            fn mask(meant: impl Fn(usize) -> bool) -> Self {
                Self::from_array(core::array::from_fn(|lane| {
                    $lane::from_bits(if meant(lane) { !0 } else { 0 })
                }))
            }

            #[inline(always)]
            fn choose(self, other: Self, mask: Self) -> Self {
                // SAFETY: see the top.
                Self(unsafe { $or($and(mask.0, self.0), $andnot(mask.0, other.0)) })
            }

            #[inline(always)]
            fn larger_size(self, other: Self) -> Self {
                let sign = Self::splat(-0.0).0;
                // SAFETY: see the top.
                Self(unsafe { $max($andnot(sign, self.0), $andnot(sign, other.0)) })
            }

            #[inline(always)]
            fn splat(value: $lane) -> Self {
                // SAFETY: see the top.
                Self(unsafe { $splat(value) })
            }

            #[inline(always)]
            fn load(numbers: &[$lane]) -> Option<Self> {
                numbers.first_chunk().copied().map(Self::from_array)
            }

            #[inline(always)]
            fn store(self, numbers: &mut [$lane]) {
                if let Some(front) = numbers.first_chunk_mut() {
                    *front = self.to_array();
                }
            }

            #[inline(always)]
            fn load_last(numbers: &[$lane]) -> Option<Self> {
                numbers.last_chunk().copied().map(Self::from_array)
            }

            #[inline(always)]
            fn store_last(self, numbers: &mut [$lane]) {
                if let Some(back) = numbers.last_chunk_mut() {
                    *back = self.to_array();
                }
            }
        }
    };
    ($name:ident, $trait:ident, $function:ident, $instruction:ident) => {
        impl $trait for $name {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                // SAFETY: see the top.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

register! {
    /// A register of SSE2.
    F64x2: __m128d = 2 of f64,
    _mm_set1_pd, _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd, _mm_sqrt_pd,
    _mm_max_pd, _mm_and_pd, _mm_andnot_pd, _mm_or_pd, words_of_sse2 = 4, one_by_one
}

register! {
    /// A register of SSE2.
    F32x4: __m128 = 4 of f32,
    _mm_set1_ps, _mm_add_ps, _mm_sub_ps, _mm_mul_ps, _mm_div_ps, _mm_sqrt_ps,
    _mm_max_ps, _mm_and_ps, _mm_andnot_ps, _mm_or_ps, words_of_sse2 = 4, one_by_one
}

register! {
    /// A register of AVX2.
    F64x4: __m256d = 4 of f64,
    _mm256_set1_pd, _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd,
    _mm256_max_pd, _mm256_and_pd, _mm256_andnot_pd, _mm256_or_pd, words_of_avx2 = 8, one_by_one
}

register! {
    /// A register of AVX2.
    F32x8: __m256 = 8 of f32,
    _mm256_set1_ps, _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps, _mm256_sqrt_ps,
    _mm256_max_ps, _mm256_and_ps, _mm256_andnot_ps, _mm256_or_ps, words_of_avx2 = 8, one_by_one
}

register! {
    /// A register of AVX-512.
    F64x8: __m512d = 8 of f64,
    _mm512_set1_pd, _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_sqrt_pd,
    _mm512_max_pd, _mm512_and_pd, _mm512_andnot_pd, _mm512_or_pd, words_of_avx512 = 16, masked_f64
}

register! {
    /// A register of AVX-512.
    F32x16: __m512 = 16 of f32,
    _mm512_set1_ps, _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps, _mm512_div_ps, _mm512_sqrt_ps,
    _mm512_max_ps, _mm512_and_ps, _mm512_andnot_ps, _mm512_or_ps, words_of_avx512 = 16, masked_f32
}

/// Without an instruction for it.
#[inline(always)]
unsafe fn words_of_sse2<V>(vector: V, words: &[u32; 4]) -> V {
    // SAFETY: the caller's vector has 128 bits, any of which are four words.
    let own: [u32; 4] = unsafe { core::mem::transmute_copy(&vector) };
    let result = words.map(|word| own[word as usize % 4]);
    // SAFETY: likewise.
    unsafe { core::mem::transmute_copy(&result) }
}

#[inline(always)]
unsafe fn words_of_avx2<V>(vector: V, words: &[u32; 8]) -> V {
    // SAFETY: the caller's vector has 256 bits.
    unsafe {
        let own = core::mem::transmute_copy(&vector);
        let words = core::mem::transmute::<[u32; 8], __m256i>(*words);
        core::mem::transmute_copy(&_mm256_permutevar8x32_epi32(own, words))
    }
}

#[inline(always)]
unsafe fn words_of_avx512<V>(vector: V, words: &[u32; 16]) -> V {
    // SAFETY: the caller's vector has 512 bits.
    unsafe {
        let own = core::mem::transmute_copy(&vector);
        let words = core::mem::transmute::<[u32; 16], __m512i>(*words);
        core::mem::transmute_copy(&_mm512_permutexvar_epi32(words, own))
    }
}

#[inline(always)]
fn one_by_one<V, T: Copy, const N: usize>(_vector: V, numbers: [T; N], places: &mut [T]) {
    for (place, number) in places.iter_mut().zip(numbers) {
        *place = number;
    }
}

#[inline(always)]
fn masked_f64(vector: __m512d, _numbers: [f64; 8], places: &mut [f64]) {
    let mask = !(0xff_u8 << places.len().min(7));
    // SAFETY: writes the numbers of the mask alone, and there are as many places.
    unsafe { _mm512_mask_storeu_pd(places.as_mut_ptr(), mask, vector) }
}

#[inline(always)]
fn masked_f32(vector: __m512, _numbers: [f32; 16], places: &mut [f32]) {
    let mask = !(0xffff_u16 << places.len().min(15));
    // SAFETY: likewise.
    unsafe { _mm512_mask_storeu_ps(places.as_mut_ptr(), mask, vector) }
}

/// Those that fuse.
macro_rules! fused {
    ($name:ident: $lane:ident, $fused:ident, $outlined:ident) => {
        impl Scalar for $name {
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                Self::splat(<$lane as Scalar>::from_f64(value))
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                // SAFETY: see the top.
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
            fn outlined<const NUMBER: usize, A, M: Part<NUMBER, A>>(
                model: &M,
                arguments: A,
            ) -> M::Output {
                dispatch::$outlined(PartOf { model, arguments })
            }
        }
    };
}

fused!(F64x4: f64, _mm256_fmadd_pd, outlined_avx2);
fused!(F32x8: f32, _mm256_fmadd_ps, outlined_avx2);
fused!(F64x8: f64, _mm512_fmadd_pd, outlined_avx512);
fused!(F32x16: f32, _mm512_fmadd_ps, outlined_avx512);

impl Scalar for F64x2 {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::splat(value)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        // SAFETY: see the top.
        let common = unsafe {
            let size = _mm_andnot_pd(_mm_set1_pd(-0.0), self.0);
            _mm_movemask_pd(_mm_cmplt_pd(size, _mm_set1_pd(double::LIMIT))) == 0b11
        };
        if common {
            return double::turn(double::reduce(self));
        }
        let (sines, cosines) = double::far(self.to_array());
        (Self::from_array(sines), Self::from_array(cosines))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }
}

impl Scalar for F32x4 {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::splat(<f32 as Scalar>::from_f64(value))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sines, cosines) = sin_cos_f32(self.to_array());
        (Self::from_array(sines), Self::from_array(cosines))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }
}

impl double::Pack for F64x2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Register::splat(value)
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm_set1_pd(-0.0);
            let quarter = _mm_castpd_si128(quarter.0);
            let next = _mm_add_epi64(quarter, _mm_set1_epi64x(1));
            let odd = _mm_and_si128(quarter, _mm_set1_epi64x(1));
            let mask = _mm_castsi128_pd(_mm_sub_epi64(_mm_setzero_si128(), odd));
            let exchange = _mm_and_pd(mask, _mm_xor_pd(sine.0, cosine.0));
            let turned = |value, quarters| {
                let signs = _mm_castsi128_pd(_mm_slli_epi64::<62>(quarters));
                Self(_mm_xor_pd(
                    _mm_xor_pd(value, exchange),
                    _mm_and_pd(sign, signs),
                ))
            };
            (turned(sine.0, quarter), turned(cosine.0, next))
        }
    }
}

impl double::Pack for F64x4 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Register::splat(value)
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        fused::Pack::exchange(quarter, sine, cosine)
    }
}

impl fused::Pack for F64x4 {
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            Self(_mm256_max_pd(
                _mm256_andnot_pd(sign, self.0),
                _mm256_andnot_pd(sign, other.0),
            ))
        }
    }

    type Array = [f64; 4];

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm256_set1_pd(-0.0);
            let quarter = _mm256_castpd_si256(quarter.0);
            let next = _mm256_add_epi64(quarter, _mm256_set1_epi64x(1));
            // Blends look at the highest bits.
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(quarter));
            let turned = |a, b, quarters| {
                let signs = _mm256_castsi256_pd(_mm256_slli_epi64::<62>(quarters));
                Self(_mm256_xor_pd(
                    _mm256_blendv_pd(a, b, odd),
                    _mm256_and_pd(sign, signs),
                ))
            };
            (
                turned(sine.0, cosine.0, quarter),
                turned(cosine.0, sine.0, next),
            )
        }
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        // SAFETY: see the top.
        unsafe {
            let size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0);
            let below = _mm256_cmp_pd::<_CMP_LT_OQ>(size, _mm256_set1_pd(limit));
            _mm256_movemask_pd(below) == 0b1111
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

impl fused::Pack for F32x8 {
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            Self(_mm256_max_ps(
                _mm256_andnot_ps(sign, self.0),
                _mm256_andnot_ps(sign, other.0),
            ))
        }
    }

    type Array = [f32; 8];

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            let quarter = _mm256_castps_si256(quarter.0);
            let next = _mm256_add_epi32(quarter, _mm256_set1_epi32(1));
            let odd = _mm256_castsi256_ps(_mm256_slli_epi32::<31>(quarter));
            let turned = |a, b, quarters| {
                let signs = _mm256_castsi256_ps(_mm256_slli_epi32::<30>(quarters));
                Self(_mm256_xor_ps(
                    _mm256_blendv_ps(a, b, odd),
                    _mm256_and_ps(sign, signs),
                ))
            };
            (
                turned(sine.0, cosine.0, quarter),
                turned(cosine.0, sine.0, next),
            )
        }
    }

    #[inline(always)]
    fn all_below(self, limit: f32) -> bool {
        // SAFETY: see the top.
        unsafe {
            let size = _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0);
            let below = _mm256_cmp_ps::<_CMP_LT_OQ>(size, _mm256_set1_ps(limit));
            _mm256_movemask_ps(below) == 0xff
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

/// The larger of two sizes, for the instruction that chooses among ranges.
const LARGER_SIZE: i32 = 0b1011;

/// a ⊕ (b ∧ c), bit by bit, as the table of a ternary instruction.
const XOR_AND: i32 = 0x78;

impl fused::Pack for F64x8 {
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        // SAFETY: see the top.
        Self(unsafe { _mm512_range_pd::<LARGER_SIZE>(self.0, other.0) })
    }

    type Array = [f64; 8];

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm512_castpd_si512(_mm512_set1_pd(-0.0));
            let quarter = _mm512_castpd_si512(quarter.0);
            let one = _mm512_set1_epi64(1);
            let next = _mm512_add_epi64(quarter, one);
            let odd = _mm512_test_epi64_mask(quarter, one);
            let turned = |a, b, quarters| {
                let value = _mm512_castpd_si512(_mm512_mask_blend_pd(odd, a, b));
                let signs = _mm512_slli_epi64::<62>(quarters);
                let value = _mm512_ternarylogic_epi64::<XOR_AND>(value, signs, sign);
                Self(_mm512_castsi512_pd(value))
            };
            (
                turned(sine.0, cosine.0, quarter),
                turned(cosine.0, sine.0, next),
            )
        }
    }

    #[inline(always)]
    fn all_below(self, limit: f64) -> bool {
        // SAFETY: see the top.
        unsafe {
            let size = _mm512_abs_pd(self.0);
            _mm512_cmp_pd_mask::<_CMP_LT_OQ>(size, _mm512_set1_pd(limit)) == 0xff
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

impl fused::Pack for F32x16 {
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        // SAFETY: see the top.
        Self(unsafe { _mm512_range_ps::<LARGER_SIZE>(self.0, other.0) })
    }

    type Array = [f32; 16];

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: see the top.
        unsafe {
            let sign = _mm512_castps_si512(_mm512_set1_ps(-0.0));
            let quarter = _mm512_castps_si512(quarter.0);
            let one = _mm512_set1_epi32(1);
            let next = _mm512_add_epi32(quarter, one);
            let odd = _mm512_test_epi32_mask(quarter, one);
            let turned = |a, b, quarters| {
                let value = _mm512_castps_si512(_mm512_mask_blend_ps(odd, a, b));
                let signs = _mm512_slli_epi32::<30>(quarters);
                let value = _mm512_ternarylogic_epi32::<XOR_AND>(value, signs, sign);
                Self(_mm512_castsi512_ps(value))
            };
            (
                turned(sine.0, cosine.0, quarter),
                turned(cosine.0, sine.0, next),
            )
        }
    }

    #[inline(always)]
    fn all_below(self, limit: f32) -> bool {
        // SAFETY: see the top.
        unsafe {
            let size = _mm512_abs_ps(self.0);
            _mm512_cmp_ps_mask::<_CMP_LT_OQ>(size, _mm512_set1_ps(limit)) == 0xffff
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
