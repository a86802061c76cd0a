//! Sine and cosine for `f32`, computed in `f64`. Two vectors of half as many numbers cost no more
//! than the compensated sums that single precision would need, and the result is correctly rounded
//! except in one case in ten thousand.

use core::f64::consts::FRAC_2_PI;
use core::hint::black_box;

use super::reduction;

/// Limit of the common range, in rad: up to 2²⁰ quarter turns the product with the first part of
/// π/2 is exact.
const LIMIT: f32 = 1_647_099.0;

/// π/2 = PART_1 + PART_2 with an error of 2⁻⁸⁶; the parts have 33 and 53 bits.
const PART_1: f64 = f64::from_bits(0x3ff9_21fb_5440_0000);
const PART_2: f64 = f64::from_bits(0x3dd0_b461_1a62_6331);

/// Constant whose addition rounds a number to an integer, which is then in the lowest bits: 1.5 ·
/// 2⁵².
const ROUND: f64 = 6_755_399_441_055_744.0;

const SIGN: u64 = 1 << 63;

/// Coefficients of sin x = x + x³ (S1 + S2 x² + S3 x⁴ + S4 x⁶), with an error below 2⁻³⁷ x for |x|
/// ≤ π/4.
const SINE: [f64; 4] = [
    -0.166_666_666_416_265_24,
    8.333_329_385_889_463e-3,
    -1.983_932_984_286_553e-4,
    2.718_311_493_989_822e-6,
];

/// Coefficients of cos x = 1 + x² (C0 + C1 x² + C2 x⁴ + C3 x⁶), with an error below 2⁻³⁴ for |x| ≤
/// π/4.
const COSINE: [f64; 4] = [
    -0.499_999_997_251_031,
    4.166_662_332_373_906e-2,
    -1.388_676_377_460_993e-3,
    2.439_044_879_627_741_6e-5,
];

/// Computes the sines and cosines of `N` angles in rad.
#[inline(always)]
pub(crate) fn sin_cos_f32<const N: usize>(angles: [f32; N]) -> ([f32; N], [f32; N]) {
    let mut common = true;
    for angle in angles {
        common &= angle.abs() < LIMIT;
    }
    let mut sines = [0.0; N];
    let mut cosines = [0.0; N];
    if !common {
        // Copies for this block only: if angles and results themselves were borrowed, they would be
        // kept in memory on the common path too.
        let (mut far_sines, mut far_cosines) = ([0.0; N], [0.0; N]);
        beyond(black_box(angles), &mut far_sines, &mut far_cosines);
        for i in 0..N {
            (sines[i], cosines[i]) = (far_sines[i], far_cosines[i]);
        }
        return (sines, cosines);
    }
    for i in 0..N {
        let (quarter, rest) = reduce(angles[i]);
        (sines[i], cosines[i]) = sin_cos_of(quarter, rest);
    }
    (sines, cosines)
}

/// Computes sines and cosines if some angles are outside the common range.
#[cold]
#[inline(never)]
fn beyond<const N: usize>(angles: [f32; N], sines: &mut [f32; N], cosines: &mut [f32; N]) {
    for i in 0..N {
        (sines[i], cosines[i]) = if angles[i].is_finite() {
            let (quarter, rest) = reduce_any(angles[i]);
            sin_cos_of(quarter, rest)
        } else {
            (f32::NAN, f32::NAN)
        };
    }
}

/// Reduces a finite angle: returns the number of the nearest multiple of π/2 in the lowest bits,
/// and the distance from it.
#[inline(always)]
pub(super) fn reduce_any(angle: f32) -> (u64, f64) {
    if angle.abs() < LIMIT {
        return reduce(angle);
    }
    let (quarter, [rest, ..]) = reduction::modulo_half_pi(f64::from(angle));
    (quarter, rest)
}

/// Reduces an angle in the common range by Cody and Waite's method.
#[inline(always)]
fn reduce(angle: f32) -> (u64, f64) {
    let angle = f64::from(angle);
    let shifted = angle * FRAC_2_PI + ROUND;
    let n = shifted - ROUND;
    (shifted.to_bits(), (angle - n * PART_1) - n * PART_2)
}

/// Returns sine and cosine of an angle that is given as quarter turns plus a small angle.
#[inline(always)]
#[allow(clippy::cast_possible_truncation)]
fn sin_cos_of(quarter: u64, angle: f64) -> (f32, f32) {
    let square = angle * angle;
    let fourth = square * square;
    let [s1, s2, s3, s4] = SINE;
    // In this form a zero keeps its sign.
    let sine = angle * (1.0 + square * ((s1 + square * s2) + fourth * (s3 + square * s4)));
    let [c0, c1, c2, c3] = COSINE;
    let cosine = 1.0 + square * ((c0 + square * c1) + fourth * (c2 + square * c3));

    let exchange = (quarter & 1).wrapping_neg() & (sine.to_bits() ^ cosine.to_bits());
    (
        f64::from_bits((sine.to_bits() ^ exchange) ^ ((quarter << 62) & SIGN)) as f32,
        f64::from_bits((cosine.to_bits() ^ exchange) ^ ((quarter.wrapping_add(1) << 62) & SIGN))
            as f32,
    )
}
