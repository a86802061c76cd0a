//! Four `f64` in one register of AVX2, for plain numbers: the compiler vectorises loops over eight
//! numbers, but not reliably loops over four.

#![allow(unsafe_code)]

use super::super::Scalar;
use super::double::{LIMIT, far, reduce, sin_cos_of};
use super::fused::FusingNumber;
use crate::simd::{F64x4, Simd};

/// Computes sines and cosines of four angles.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub(super) fn sin_cos_quad(angles: [f64; 4]) -> ([f64; 4], [f64; 4]) {
    let pack = F64x4::from_array(angles);
    if Simd::<f64>::larger_size(F64x4::from_f64(0.0), pack).all_below(LIMIT) {
        let (sine, cosine) = sin_cos_of(reduce(pack));
        (sine.to_array(), cosine.to_array())
    } else {
        far(angles)
    }
}
