//! Registers of SSE2, which have no fused multiply–add and use the portable sines.

use core::arch::x86_64::*;

use super::super::Simd;
use super::{F32x4, F64x2};
use crate::scalar::Scalar;
use crate::scalar::kind::ByKind;
use crate::scalar::sincos::{double, sin_cos_f32};

impl Scalar for F64x2 {
    #[inline(always)]
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<f64>()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        <Self as Simd<f64>>::splat(value)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        // SAFETY: the build has SSE2.
        let common = unsafe {
            let size = _mm_andnot_pd(_mm_set1_pd(-0.0), self.0);
            _mm_movemask_pd(_mm_cmplt_pd(size, _mm_set1_pd(double::LIMIT))) == 0b11
        };
        if common {
            return double::sin_cos_of(double::reduce(self));
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
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<f32>()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        <Self as Simd<f32>>::splat(<f32 as Scalar>::from_f64(value))
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

impl double::UnfusedNumber for F64x2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        <Self as Simd<f64>>::splat(value)
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        // SAFETY: the build has SSE2.
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
