//! Sine and cosine for `f32`, computed in `f64`: two vectors of half as many
//! numbers cost no more than the compensated sums that single precision asks
//! for, and the result is rounded correctly but for one case in ten thousand.

use core::f64::consts::FRAC_2_PI;
use core::hint::black_box;

use super::reduction;

/// The common range: up to 2²⁰ quarter turns the product with the first part of
/// π/2 is exact.
const LIMIT: f32 = 1_647_099.0;

/// π/2 = PART_1 + PART_2 up to 2⁻⁸⁶; 33 and 53 bits.
const PART_1: f64 = f64::from_bits(0x3ff9_21fb_5440_0000);
const PART_2: f64 = f64::from_bits(0x3dd0_b461_1a62_6331);

/// Adding 1.5 · 2⁵² rounds to an integer and leaves it in the lowest bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

const SIGN: u64 = 1 << 63;

/// sin x = x + x³ (S1 + S2 x² + S3 x⁴ + S4 x⁶) up to 2⁻³⁷ x for |x| ≤ π/4.
const SINE: [f64; 4] = [
    -0.166_666_666_416_265_24,
    8.333_329_385_889_463e-3,
    -1.983_932_984_286_553e-4,
    2.718_311_493_989_822e-6,
];

/// cos x = 1 + x² (C0 + C1 x² + C2 x⁴ + C3 x⁶) up to 2⁻³⁴ for |x| ≤ π/4.
const COSINE: [f64; 4] = [
    -0.499_999_997_251_031,
    4.166_662_332_373_906e-2,
    -1.388_676_377_460_993e-3,
    2.439_044_879_627_741_6e-5,
];

/// Sines and cosines of `N` angles.
#[inline(always)]
pub(crate) fn sin_cos_f32<const N: usize>(angles: [f32; N]) -> ([f32; N], [f32; N]) {
    let mut common = true;
    for angle in angles {
        common &= angle.abs() < LIMIT;
    }
    let mut sines = [0.0; N];
    let mut cosines = [0.0; N];
    if !common {
        // Copies for this block alone: were angles and results themselves lent out,
        // they would live in memory on the common path too.
        let (mut far_sines, mut far_cosines) = ([0.0; N], [0.0; N]);
        beyond(black_box(angles), &mut far_sines, &mut far_cosines);
        for i in 0..N {
            (sines[i], cosines[i]) = (far_sines[i], far_cosines[i]);
        }
        return (sines, cosines);
    }
    for i in 0..N {
        let (quarter, rest) = reduce(angles[i]);
        (sines[i], cosines[i]) = turn(quarter, rest);
    }
    (sines, cosines)
}

/// Sines and cosines with angles outside the common range among them.
#[cold]
#[inline(never)]
fn beyond<const N: usize>(angles: [f32; N], sines: &mut [f32; N], cosines: &mut [f32; N]) {
    for i in 0..N {
        (sines[i], cosines[i]) = if angles[i].is_finite() {
            let (quarter, rest) = reduce_any(angles[i]);
            turn(quarter, rest)
        } else {
            (f32::NAN, f32::NAN)
        };
    }
}

/// The number of the nearest multiple of π/2 in the lowest bits, and the distance
/// of a finite angle from it.
#[inline(always)]
pub(super) fn reduce_any(angle: f32) -> (u64, f64) {
    if angle.abs() < LIMIT {
        return reduce(angle);
    }
    let (quarter, [rest, ..]) = reduction::modulo_half_pi(f64::from(angle));
    (quarter, rest)
}

/// Cody and Waite's reduction, for the common range.
#[inline(always)]
fn reduce(angle: f32) -> (u64, f64) {
    let angle = f64::from(angle);
    let shifted = angle * FRAC_2_PI + ROUND;
    let n = shifted - ROUND;
    (shifted.to_bits(), (angle - n * PART_1) - n * PART_2)
}

/// Sine and cosine of quarter turns plus a small angle.
#[inline(always)]
#[allow(clippy::cast_possible_truncation)]
fn turn(quarter: u64, angle: f64) -> (f32, f32) {
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
