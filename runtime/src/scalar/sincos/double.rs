//! Sine and cosine for `f64`.

use core::f64::consts::FRAC_2_PI;
use core::hint::black_box;
use core::ops::{Add, Mul, Sub};

use super::reduction;

/// Limit of the common range, in rad. Up to 2¹⁶ quarter turns, the products with the parts of π/2
/// below are exact. In this range no angle comes closer to a multiple of π/2 than 2⁻⁶¹ (29 quarter
/// turns, found by trying all), while the neglected rest is 2⁻¹²⁵.
pub(crate) const LIMIT: f64 = 102_943.0;

/// π/2 = PART_1 + PART_2 + PART_3 with an error of 2⁻¹³⁰; the parts have 37, 37 and 53 bits.
const PART_1: f64 = f64::from_bits(0x3ff9_21fb_5444_0000);
const PART_2: f64 = f64::from_bits(0x3d86_8c23_4c4c_0000);
const PART_3: f64 = f64::from_bits(0x3b29_8a2e_0370_7345);

/// Constant whose addition rounds a number to an integer, which is then in the lowest bits: 1.5 ·
/// 2⁵².
const ROUND: f64 = 6_755_399_441_055_744.0;

const SIGN: u64 = 1 << 63;

/// Coefficients of sin x = x + x³ (S1 + S2 x² + … + S6 x¹⁰), with an error below 2⁻⁵⁸ x for |x| ≤
/// π/4.
pub(super) const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// Coefficients of cos x = 1 − x²/2 + x⁴ (C1 + C2 x² + … + C6 x¹⁰), with an error below 2⁻⁵⁸ for
/// |x| ≤ π/4.
pub(super) const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// A number, or a register of several numbers, for sines that are computed in a fixed order of
/// operations without fused multiply–add.
pub(crate) trait UnfusedNumber:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// Returns the same number in every lane.
    fn splat(value: f64) -> Self;

    /// Rotates a sine and cosine by a number of quarter turns, which is in the lowest bits of
    /// `quarter`. Odd numbers exchange sine and cosine; the second bit determines the signs.
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self);
}

impl UnfusedNumber for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn exchange(quarter: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let quarter = quarter.to_bits();
        let exchange = (quarter & 1).wrapping_neg() & (sine.to_bits() ^ cosine.to_bits());
        let sine_sign = (quarter << 62) & SIGN;
        let cosine_sign = (quarter.wrapping_add(1) << 62) & SIGN;
        (
            f64::from_bits(sine.to_bits() ^ exchange ^ sine_sign),
            f64::from_bits(cosine.to_bits() ^ exchange ^ cosine_sign),
        )
    }
}

/// An angle minus the nearest multiple of π/2. The difference is `high − low`; the lowest two bits
/// of `quarter` hold the number of quarter turns. `low` is below 2⁻⁵³, and below 2⁻⁹ of `high`.
#[derive(Clone, Copy)]
pub(crate) struct Reduced<P> {
    quarter: P,
    high: P,
    low: P,
}

/// Computes the sines and cosines of `N` angles in rad.
#[inline(always)]
pub(crate) fn sin_cos_f64<const N: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    let mut common = true;
    for angle in angles {
        common &= angle.abs() < LIMIT;
    }
    let mut sines = [0.0; N];
    let mut cosines = [0.0; N];
    if !common {
        return far(angles);
    }
    for i in 0..N {
        (sines[i], cosines[i]) = sin_cos_of(reduce(angles[i]));
    }
    (sines, cosines)
}

/// Computes sines and cosines if some angles are outside the common range.
#[inline(always)]
pub(crate) fn far<const N: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    // Copies for this block only: if angles and results themselves were borrowed, they would be
    // kept in memory on the common path too.
    let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
    beyond(black_box(angles), &mut sines, &mut cosines);
    (sines, cosines)
}

#[cold]
#[inline(never)]
fn beyond<const N: usize>(angles: [f64; N], sines: &mut [f64; N], cosines: &mut [f64; N]) {
    for i in 0..N {
        let angle = angles[i];
        if angle.abs() < LIMIT {
            (sines[i], cosines[i]) = sin_cos_of(reduce(angle));
        } else if angle.is_finite() {
            let (quarter, [high, low, _]) = reduction::modulo_half_pi(angle);
            (sines[i], cosines[i]) = sin_cos_of(Reduced {
                quarter: f64::from_bits(quarter),
                high,
                low: -low,
            });
        } else {
            (sines[i], cosines[i]) = (f64::NAN, f64::NAN);
        }
    }
}

/// Reduces an angle in the common range by Cody and Waite's method.
#[inline(always)]
pub(crate) fn reduce<P: UnfusedNumber>(angle: P) -> Reduced<P> {
    let quarter = angle * P::splat(FRAC_2_PI) + P::splat(ROUND);
    let n = quarter - P::splat(ROUND);
    // Both products and the first difference are exact.
    let first = angle - n * P::splat(PART_1);
    let second = n * P::splat(PART_2);
    let high = first - second;
    let lost = (first - high) - second;
    Reduced {
        quarter,
        high,
        low: n * P::splat(PART_3) - lost,
    }
}

/// Returns sine and cosine of an angle that is given as quarter turns plus a small angle.
#[inline(always)]
pub(crate) fn sin_cos_of<P: UnfusedNumber>(angle: Reduced<P>) -> (P, P) {
    let Reduced { quarter, high, low } = angle;
    let square = high * high;
    let fourth = square * square;
    let half = P::splat(0.5) * square;
    let one = P::splat(1.0);
    let head = one - half;
    // Pairs of terms: half the latency of Horner's scheme.
    let [s1, s2, s3, s4, s5, s6] = SINE.map(P::splat);
    let tail = (s1 + square * s2) + fourth * ((s3 + square * s4) + fourth * (s5 + square * s6));
    // sin(high − low) = sin(high) − low within 0.15 ulp; a zero keeps its sign.
    let sine = high - (low - (square * high) * tail);

    let [c1, c2, c3, c4, c5, c6] = COSINE.map(P::splat);
    let tail = (c1 + square * c2) + fourth * ((c3 + square * c4) + fourth * (c5 + square * c6));
    // cos(high − low) = cos(high) + low sin(high)
    let cosine = head + (((one - head) - half) + (fourth * tail + high * low));
    P::exchange(quarter, sine, cosine)
}
