//! Sine and cosine of several angles at once, for `f64` and `f32`: portable, and in fused
//! arithmetic ([`fused`]). Except for the accuracy, the following describes the portable ones.
//!
//! An angle within the common range (2¹⁶ quarter turns, 10⁵ rad, for `f64`) takes no branch and no
//! table: reduction by Cody and Waite, two polynomials, and a selection by bits. Every stage is a
//! loop over the angles, so that the compiler can put several in one vector register. If any angle
//! is outside the range, infinite or NaN, all of them are computed one by one, large ones after the
//! reduction by Payne and Hanek ([`reduction`]).
//!
//! # Rule
//! An angle gives the same bits alone, together with others, at any index and for any instruction
//! set: the operations are additions, multiplications and conversions that IEEE 754 defines, in a
//! fixed order. Nothing is fused (`mul_add` is never used, and Rust does not contract operations).
//!
//! # Accuracy
//! The error is below 0.9 units in the last place for `f64` and 0.502 for `f32`, over their whole
//! ranges (the largest among 1.2 million values of each: 0.872 and 0.5009). In fused arithmetic it
//! is below 0.9 for both (0.87 and 0.83 among as many values). sin(−x) = −sin(x), also for zeros;
//! cos(−x) = cos(x). Infinite angles and NaN give NaN.
//!
//! # Sources
//! M. Payne and R. Hanek, "Radian reduction for trigonometric functions", ACM SIGNUM Newsletter 18
//! (1983) 19; W. J. Cody and W. Waite, Software Manual for the Elementary Functions (1980); K. C.
//! Ng, "Argument reduction for huge arguments: good to the last bit" (1992). The polynomials are
//! those of FDLIBM 5.3 (`k_sin.c`, `k_cos.c`) and of FreeBSD's msun (`k_sinf.c`, `k_cosf.c`, B. D.
//! Evans): Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft,
//! a Sun Microsystems, Inc. business. Permission to use, copy, modify, and distribute this software
//! is freely granted, provided that this notice is preserved.

pub(crate) mod double;
pub(crate) mod fused;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod quad;
pub(crate) mod reduction;
mod several;
mod single;
mod tail;
#[cfg(test)]
mod tests;

pub(crate) use double::sin_cos_f64;
pub(crate) use several::{several_f32, several_f64};
pub(crate) use single::sin_cos_f32;
