//! Sine and cosine computed with fused multiply–add, for the wide registers and [`Fused`] numbers.
//! These functions take fewer operations than the portable ones, and results differ in the last
//! bits; the error is below one unit in the last place.
//!
//! The first part of π/2 uses all of its digits: a fused product minus the angle is exact even if
//! the part does not end with zeros.

// Without registers no code checks the range of several angles at a time.
#![cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]

use core::hint::black_box;

use super::super::sin_cos_pairs::SinesAndCosines;
use super::super::{Lane, Scalar};
use super::reduction;
use super::tail::{self, Tail, for_each};
use crate::simd::{Fused, Simd};

/// A number, or a register of several numbers, for sines that are computed with fused multiply–add.
pub(crate) trait FusingNumber: Simd<Self::Lane> {
    /// Type of the number in each lane of the register.
    type Lane: Float;
    /// Array with one number per lane.
    type Array: Copy + AsRef<[Self::Lane]> + AsMut<[Self::Lane]>;

    /// Rotates a sine and cosine by a number of quarter turns, which is in the lowest bits of
    /// `quarter`; the sine is given as `high − lost`.
    ///
    /// Odd numbers replace (s, c) by (c, −s); the second bit changes both signs.
    fn exchange(quarter: Self, high: Self, lost: Self, cosine: Self) -> (Self, Self);

    /// Returns the bits of `self`, with those bits set in which `one` and `other` differ.
    fn or_differing(self, one: Self, other: Self) -> Self;

    /// Returns true if none of the bits [`Float::HIGH_BITS`] is set.
    fn only_low_bits(self) -> bool;

    /// Returns true if the numbers in all lanes are below `limit`.
    fn all_below(self, limit: Self::Lane) -> bool;

    /// Creates a register from the numbers of its lanes.
    fn from_numbers(numbers: Self::Array) -> Self;

    /// Largest angle of the common range, in rad, slightly reduced. For every number of quarter
    /// turns in this range, the distance between an angle and a multiple of π/2 has been examined.
    fn to_numbers(self) -> Self::Array;
}

/// Constants of one precision.
pub(crate) trait Float: Lane {
    /// A single number that fuses.
    type One: FusingNumber<Lane = Self>;
    /// A register of AVX2.
    type Several: FusingNumber<Lane = Self>;
    /// Limit of the angles, a little inside the common range. For all numbers of quarter turns in
    /// this range, the distance between an angle and a multiple of π/2 has been examined.
    const LIMIT: Self;
    /// 2/π.
    const TWO_OVER_PI: Self;
    /// Largest number of quarter turns in the common range of angles, which reaches from −QUARTERS
    /// to QUARTERS − 1.
    const QUARTERS: Self;
    /// Constant whose addition rounds a number to an integer, which is then in the lowest bits: 1.5
    /// times a power of two.
    const INTEGERS: Self;
    /// Sum of `QUARTERS` and `INTEGERS`. A number plus this constant has the same higher bits as
    /// `INTEGERS` if and only if the number is in the common range.
    const ROUND: Self;
    /// Mask of all bits except the lowest ones, which hold the number of quarter turns.
    const HIGH_BITS: Self;
    /// π/2 as a sum of positive parts. Products with the second part are exact, and have so few
    /// digits that subtracting an angle smaller than the product is exact too.
    const HALF_PI: [Self; 3];
    /// Polynomial S in sin x = x + x³ S(x²) for |x| ≤ π/4.
    const SINE: Tail<Self>;
    /// Polynomial C in cos x = 1 − x²/2 + x⁴ C(x²) for |x| ≤ π/4.
    const COSINE: Tail<Self>;

    /// Returns `a * b + c`, rounded once.
    fn fused(a: Self, b: Self, c: Self) -> Self;

    /// Reduces an angle outside the common range: returns the number of the nearest multiple of π/2
    /// in the lowest bits, and the distance from it as a difference of two numbers; NaN if the
    /// angle is infinite or NaN.
    fn far(angle: Self) -> (Self, [Self; 2]);
}

impl Float for f64 {
    type One = Fused<f64>;
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    type Several = crate::simd::F64x4;
    #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
    type Several = Fused<f64>;

    const LIMIT: f64 = 102_942.0;
    const TWO_OVER_PI: f64 = core::f64::consts::FRAC_2_PI;
    const QUARTERS: f64 = 65_536.0;
    const INTEGERS: f64 = 6_755_399_441_055_744.0;
    const ROUND: f64 = Self::INTEGERS + Self::QUARTERS;
    const HIGH_BITS: f64 = f64::from_bits(!((1 << 17) - 1));
    const HALF_PI: [f64; 3] = [
        core::f64::consts::FRAC_PI_2,
        f64::from_bits(0x3c91a62633140000),
        f64::from_bits(0x3a3701b839a25205),
    ];
    const SINE: Tail<f64> = Tail::Long(super::double::SINE);
    const COSINE: Tail<f64> = tail::COSINE;

    #[inline(always)]
    fn fused(a: f64, b: f64, c: f64) -> f64 {
        #[cfg(feature = "std")]
        return f64::mul_add(a, b, c);
        #[cfg(all(feature = "libm", not(feature = "std")))]
        return libm::fma(a, b, c);
    }

    fn far(angle: f64) -> (f64, [f64; 2]) {
        if !angle.is_finite() {
            return (0.0, [f64::NAN; 2]);
        }
        let (quarter, [high, low, _]) = reduction::modulo_half_pi(angle);
        (f64::from_bits(quarter), [high, -low])
    }
}

impl Float for f32 {
    type One = Fused<f32>;
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
    type Several = crate::simd::F32x8;
    #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
    type Several = Fused<f32>;

    const LIMIT: f32 = 803.0;
    const TWO_OVER_PI: f32 = core::f32::consts::FRAC_2_PI;
    const QUARTERS: f32 = 512.0;
    const INTEGERS: f32 = 12_582_912.0;
    const ROUND: f32 = Self::INTEGERS + Self::QUARTERS;
    const HIGH_BITS: f32 = f32::from_bits(!((1 << 10) - 1));
    const HALF_PI: [f32; 3] = [
        f32::from_bits(0x3fc9_0fda),
        f32::from_bits(0x33a22000),
        f32::from_bits(0x2c34611a),
    ];
    /// Minimax polynomial for the sine, with errors up to 2⁻²⁸; for the cosine they are up to 2⁻³³.
    const SINE: Tail<f32> = Tail::Short([-0.166_666_55, 8.332_177e-3, -1.951_713_8e-4]);
    const COSINE: Tail<f32> = Tail::Short([4.166_664_6e-2, -1.388_736_7e-3, 2.443_827_2e-5]);

    #[inline(always)]
    fn fused(a: f32, b: f32, c: f32) -> f32 {
        #[cfg(feature = "std")]
        return f32::mul_add(a, b, c);
        #[cfg(all(feature = "libm", not(feature = "std")))]
        return libm::fmaf(a, b, c);
    }

    #[allow(clippy::cast_possible_truncation)]
    fn far(angle: f32) -> (f32, [f32; 2]) {
        if !angle.is_finite() {
            return (0.0, [f32::NAN; 2]);
        }
        let (quarter, rest) = super::single::reduce_any(angle);
        let high = rest as f32;
        let low = (f64::from(high) - rest) as f32;
        (f32::from_bits(quarter as u32 & 3), [high, low])
    }
}

/// Number of angles that are computed in lockstep, so that the processor works on the others while
/// it waits for the result of one operation.
const GROUP: usize = 4;

/// Computes the sines and cosines of angles in the common range. If an angle is outside, bits above
/// the lowest are set in `seen`.
#[inline(always)]
fn common<P: FusingNumber, const G: usize>(angles: [P; G], seen: &mut P) -> ([P; G], [P; G]) {
    let [part_1, part_2, part_3] = P::Lane::HALF_PI;
    let (part_1, part_2, part_3) = (P::splat(part_1), P::splat(part_2), P::splat(part_3));
    let round = P::splat(P::Lane::ROUND);
    let turns = P::splat(P::Lane::TWO_OVER_PI);
    let quarters = for_each!(round; i => angles[i].mul_add(turns, round));
    for quarters in quarters {
        *seen = seen.or_differing(quarters, P::splat(P::Lane::INTEGERS));
    }
    let n = for_each!(round; i => quarters[i] - round);
    // Exact: a multiple of the last place of π/2 that is below one.
    let first = for_each!(round; i => (-n[i]).mul_add(part_1, angles[i]));
    // Exact too, as is the rounding error of the difference.
    let second = for_each!(round; i => n[i] * part_2);
    let high = for_each!(round; i => first[i] - second[i]);
    let low = for_each!(round; i => high[i] - first[i]);
    let low = for_each!(round; i => low[i] + second[i]);
    let low = for_each!(round; i => n[i].mul_add(part_3, low[i]));
    sin_cos_of(quarters, high, low)
}

/// Returns the sine and cosine of angles given as quarter turns plus `high − low`. The longest
/// chain of operations needs `high` only; `low` is used late.
#[inline(always)]
fn sin_cos_of<P: FusingNumber, const G: usize>(
    quarters: [P; G],
    high: [P; G],
    low: [P; G],
) -> ([P; G], [P; G]) {
    let one = P::from_f64(1.0);
    let half = P::from_f64(-0.5);
    let square = for_each!(one; i => high[i] * high[i]);
    let tail = tail::evaluate(square, P::Lane::SINE);
    let cube = for_each!(one; i => high[i] * square[i]);
    // sin(high − low) = sin(high) − low within 0.15 ulp; a zero keeps its sign.
    let lost = for_each!(one; i => (-cube[i]).mul_add(tail[i], low[i]));
    let tail = tail::evaluate(square, P::Lane::COSINE);
    let tail = for_each!(one; i => square[i].mul_add(tail[i], half));
    // cos(high − low) = cos(high) + high low = 1 + high (high tail + low)
    let slope = for_each!(one; i => high[i].mul_add(tail[i], low[i]));
    let cosine = for_each!(one; i => high[i].mul_add(slope[i], one));
    let (mut sines, mut cosines) = (cosine, cosine);
    for i in 0..G {
        (sines[i], cosines[i]) = P::exchange(quarters[i], high[i], lost[i], cosine[i]);
    }
    (sines, cosines)
}

/// Computes the sines and cosines of angles in registers, of any magnitude.
#[inline(always)]
pub(crate) fn each<P: FusingNumber, const N: usize>(angles: &[P; N]) -> ([P; N], [P; N]) {
    let zero = [P::from_f64(0.0); N];
    let (mut sines, mut cosines) = (zero, zero);
    if !groups(angles, &mut sines, &mut cosines) {
        // Copies for this block only: if angles and results themselves were borrowed, they would be
        // kept in memory on the common path too.
        let (mut far_sines, mut far_cosines) = (zero, zero);
        let angles = black_box(*angles);
        beyond(&angles, &mut far_sines, &mut far_cosines);
        (sines, cosines) = (far_sines, far_cosines);
    }
    (sines, cosines)
}

/// Returns true if all angles are in the common range.
#[inline(always)]
fn all_near<P: FusingNumber>(angles: &[P]) -> bool {
    // A NaN may be overlooked here: its sine is NaN on both paths.
    let mut largest = P::from_f64(0.0);
    for &angle in angles {
        largest = largest.larger_size(angle);
    }
    largest.all_below(P::Lane::LIMIT)
}

/// Computes the sines and cosines of all angles if at least one is outside the common range;
/// otherwise returns `None`.
#[inline(always)]
pub(crate) fn ahead<P: FusingNumber, const N: usize>(
    angles: &[P; N],
) -> Option<SinesAndCosines<P, N>> {
    if all_near(angles) {
        return None;
    }
    // Copies, as in `each`.
    let zero = P::from_f64(0.0);
    let (mut sines, mut cosines) = ([zero; N], [zero; N]);
    let angles = black_box(*angles);
    beyond(&angles, &mut sines, &mut cosines);
    Some((sines, cosines))
}

/// Computes sines and cosines of angles in the common range, in lockstep.
#[inline(always)]
pub(crate) fn near<P: FusingNumber, const N: usize>(angles: &[P; N]) -> SinesAndCosines<P, N> {
    common(*angles, &mut P::from_f64(0.0))
}

/// Computes sines and cosines in groups of registers. Returns false if some angle is outside the
/// common range.
#[inline(always)]
fn groups<P: FusingNumber>(angles: &[P], sines: &mut [P], cosines: &mut [P]) -> bool {
    let mut seen = P::from_f64(0.0);
    let mut start = 0;
    while start + GROUP <= angles.len() {
        group::<P, GROUP>(angles, sines, cosines, start, &mut seen);
        start += GROUP;
    }
    match angles.len() % GROUP {
        0 => {}
        1 => group::<P, 1>(angles, sines, cosines, start, &mut seen),
        2 => group::<P, 2>(angles, sines, cosines, start, &mut seen),
        _ => group::<P, 3>(angles, sines, cosines, start, &mut seen),
    }
    seen.only_low_bits()
}

/// Computes the sines and cosines of the `G` angles from index `start` on.
#[inline(always)]
fn group<P: FusingNumber, const G: usize>(
    angles: &[P],
    sines: &mut [P],
    cosines: &mut [P],
    start: usize,
    seen: &mut P,
) {
    let group = for_each!(angles[start]; i => angles[start + i]);
    let (some_sines, some_cosines) = common(group, seen);
    for i in 0..G {
        (sines[start + i], cosines[start + i]) = (some_sines[i], some_cosines[i]);
    }
}

/// Computes sines and cosines one by one, because some angles are outside the common range.
#[cold]
#[inline(never)]
fn beyond<P: FusingNumber, const N: usize>(
    angles: &[P; N],
    sines: &mut [P; N],
    cosines: &mut [P; N],
) {
    for i in 0..N {
        let angles = angles[i].to_numbers();
        let (mut all_sines, mut all_cosines) = (angles, angles);
        let results = all_sines.as_mut().iter_mut().zip(all_cosines.as_mut());
        for (&angle, (sine, cosine)) in angles.as_ref().iter().zip(results) {
            (*sine, *cosine) = one(angle);
        }
        sines[i] = P::from_numbers(all_sines);
        cosines[i] = P::from_numbers(all_cosines);
    }
}

/// Computes sine and cosine of one angle of any magnitude.
#[inline(always)]
fn one<T: Float>(angle: T) -> (T, T) {
    let mut seen = T::One::from_f64(0.0);
    let near = common([T::One::splat(angle)], &mut seen);
    let ([sine], [cosine]) = if seen.only_low_bits() {
        near
    } else {
        let (quarter, [high, low]) = T::far(angle);
        sin_cos_of(
            [T::One::splat(quarter)],
            [T::One::splat(high)],
            [T::One::splat(low)],
        )
    };
    let number = |value: T::One| {
        let numbers = value.to_numbers();
        numbers.as_ref().first().copied().unwrap_or(angle)
    };
    (number(sine), number(cosine))
}

/// Computes the sines and cosines of the angles of one state: a single angle by itself, several in
/// AVX2 registers, the last of which may overlap the one before.
#[inline(always)]
pub(crate) fn several<T: Float, const N: usize>(
    angles: &[Fused<T>; N],
) -> ([Fused<T>; N], [Fused<T>; N])
where
    Fused<T>: FusingNumber<Lane = T>,
{
    let zero = Fused::splat(T::from_f64(0.0));
    let (mut sines, mut cosines) = ([zero; N], [zero; N]);
    if N == 1 {
        return each(angles);
    }
    let lanes = T::Several::LANES;
    let mut seen = T::Several::from_f64(0.0);
    let mut start = 0;
    while start < N {
        let first = start.min(N.saturating_sub(lanes));
        // Lanes without an angle get the last one.
        let mut numbers = T::Several::splat(angles[N - 1].0).to_numbers();
        for (number, angle) in numbers.as_mut().iter_mut().zip(&angles[first..]) {
            *number = angle.0;
        }
        let pack = T::Several::from_numbers(numbers);
        let ([sine], [cosine]) = common([pack], &mut seen);
        let (sine, cosine) = (sine.to_numbers(), cosine.to_numbers());
        let results = sines[first..].iter_mut().zip(&mut cosines[first..]);
        let found = sine.as_ref().iter().zip(cosine.as_ref());
        for ((sine, cosine), found) in results.zip(found) {
            (sine.0, cosine.0) = (*found.0, *found.1);
        }
        start += lanes;
    }
    if !seen.only_low_bits() {
        let (mut far_sines, mut far_cosines) = ([zero; N], [zero; N]);
        let angles = black_box(*angles);
        beyond(&angles, &mut far_sines, &mut far_cosines);
        for i in 0..N {
            (sines[i], cosines[i]) = (far_sines[i], far_cosines[i]);
        }
    }
    (sines, cosines)
}
