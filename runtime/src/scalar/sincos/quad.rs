//! Four `f64` in one register of AVX2, for plain numbers: the compiler finds the
//! vectors in loops over eight numbers, but not reliably in four.

#![allow(unsafe_code)]

use core::arch::x86_64::{
    __m256d, _CMP_LT_OQ, _mm256_add_epi64, _mm256_add_pd, _mm256_and_pd, _mm256_andnot_pd,
    _mm256_castpd_si256, _mm256_castsi256_pd, _mm256_cmp_pd, _mm256_movemask_pd, _mm256_mul_pd,
    _mm256_set_pd, _mm256_set1_epi64x, _mm256_set1_pd, _mm256_setzero_si256, _mm256_slli_epi64,
    _mm256_sub_epi64, _mm256_sub_pd, _mm256_xor_pd,
};
use core::hint::black_box;
use core::ops::{Add, Mul, Sub};

use super::double::{LIMIT, Pack, beyond, reduce, turn};

/// Exists only in functions that are compiled for AVX2: `sin_cos_quad` alone
/// makes values of this type, and lends them to nobody. That is what makes the
/// calls below sound. None of them touches memory.
#[derive(Clone, Copy)]
struct Quad(__m256d);

macro_rules! operator {
    ($trait:ident, $function:ident, $instruction:ident) => {
        impl $trait for Quad {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                // SAFETY: a `Quad` exists, so AVX2 does.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

operator!(Add, add, _mm256_add_pd);
operator!(Sub, sub, _mm256_sub_pd);
operator!(Mul, mul, _mm256_mul_pd);

impl Pack for Quad {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: called from `sin_cos_quad` only, through `reduce` and `turn`.
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: a `Quad` exists, so AVX2 does.
        unsafe {
            let one = _mm256_set1_epi64x(1);
            let sign = _mm256_set1_pd(-0.0);
            let quarter = _mm256_castpd_si256(quarter.0);
            let next = _mm256_add_epi64(quarter, one);
            let odd = _mm256_and_pd(_mm256_castsi256_pd(quarter), _mm256_castsi256_pd(one));
            let mask = _mm256_castsi256_pd(_mm256_sub_epi64(
                _mm256_setzero_si256(),
                _mm256_castpd_si256(odd),
            ));
            let exchange = _mm256_and_pd(mask, _mm256_xor_pd(sine.0, cosine.0));
            let sine_sign =
                _mm256_and_pd(sign, _mm256_castsi256_pd(_mm256_slli_epi64::<62>(quarter)));
            let cosine_sign =
                _mm256_and_pd(sign, _mm256_castsi256_pd(_mm256_slli_epi64::<62>(next)));
            (
                Self(_mm256_xor_pd(_mm256_xor_pd(sine.0, exchange), sine_sign)),
                Self(_mm256_xor_pd(
                    _mm256_xor_pd(cosine.0, exchange),
                    cosine_sign,
                )),
            )
        }
    }
}

/// Sines and cosines of four angles.
#[target_feature(enable = "avx2")]
#[inline]
pub(super) fn sin_cos_quad(angles: [f64; 4]) -> ([f64; 4], [f64; 4]) {
    let pack = quad(angles);
    let size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), pack.0);
    let common = _mm256_cmp_pd::<_CMP_LT_OQ>(size, _mm256_set1_pd(LIMIT));
    let (sine, cosine) = if _mm256_movemask_pd(common) == 0b1111 {
        turn(reduce(pack))
    } else {
        // Copies, as in `sin_cos_f64`.
        let (mut sines, mut cosines) = ([0.0; 4], [0.0; 4]);
        beyond(black_box(angles), &mut sines, &mut cosines);
        (quad(sines), quad(cosines))
    };
    (numbers(sine), numbers(cosine))
}

/// Number by number, so that no wide load waits for narrow stores.
#[target_feature(enable = "avx2")]
#[inline]
fn quad([a, b, c, d]: [f64; 4]) -> Quad {
    Quad(_mm256_set_pd(d, c, b, a))
}

#[inline(always)]
fn numbers(quad: Quad) -> [f64; 4] {
    // SAFETY: both types are four `f64` in this order, without padding.
    unsafe { core::mem::transmute::<__m256d, [f64; 4]>(quad.0) }
}
