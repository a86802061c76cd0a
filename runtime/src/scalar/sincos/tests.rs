use core::array::from_fn;
use std::vec::Vec;

use super::{sin_cos_f32, sin_cos_f64};
use crate::scalar::reference::{Reference, Signed, angles, parts};
use crate::scalar::{InstructionSet, Lane, Lanes, Scalar};
use crate::simd::dispatch::{or_skip, skip_missing};
use crate::simd::dispatch::{run_fused, run_in_registers, run_wide};
use crate::simd::{Fused, Kernel, Simd};

/// Returns the error of `value` in units in the last place of a type with `digits` bits, relative
/// to the reference.
fn ulps(value: f64, exact: &Signed, digits: i32, least: i32) -> f64 {
    let (mantissa, exponent) = parts(exact.size.to_f64());
    let top = exponent + 63 - mantissa.leading_zeros() as i32;
    exact.error(value) / 2.0_f64.powi((top + 1 - digits).max(least))
}

#[test]
fn f64_is_right_to_an_ulp_everywhere() {
    let reference = Reference::new();
    let mut worst = (0.0, 0.0);
    for angle in angles(4000) {
        let ([sine], [cosine]) = sin_cos_f64([angle]);
        let (exact_sine, exact_cosine) = reference.sin_cos(&[angle]);
        for (value, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            let error = ulps(value, &exact, 53, -1074);
            assert!(error < 0.9, "{angle:e}: {error} ulp");
            if error > worst.0 {
                worst = (error, angle);
            }
        }
    }
    std::println!("worst error of f64: {:.4} ulp at {:e}", worst.0, worst.1);
}

#[test]
fn f32_is_nearly_always_rounded_correctly() {
    let reference = Reference::new();
    let mut worst = (0.0, 0.0);
    let angles = angles(4000).into_iter().map(|angle| angle as f32);
    for angle in angles.filter(|angle| angle.is_finite()).chain([f32::MAX]) {
        let ([sine], [cosine]) = sin_cos_f32([angle]);
        let (exact_sine, exact_cosine) = reference.sin_cos(&[f64::from(angle)]);
        for (value, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            let error = ulps(f64::from(value), &exact, 24, -149);
            assert!(error < 0.502, "{angle:e}: {error} ulp");
            if error > worst.0 {
                worst = (error, f64::from(angle));
            }
        }
    }
    std::println!("worst error of f32: {:.6} ulp at {:e}", worst.0, worst.1);
}

/// Test computation: sines and cosines of the angles of one state, in fused arithmetic.
struct SinesInFused<T, const N: usize>([T; N]);

impl<T: Lane, const N: usize> Kernel<T> for SinesInFused<T, N>
where
    Fused<T>: Scalar,
{
    type Output = ([T; N], [T; N]);

    #[inline(always)]
    fn run<V: Simd<T>>(self) -> Self::Output {
        let (sines, cosines) = Fused::sin_cos_each(&self.0.map(Fused));
        (sines.map(|x| x.0), cosines.map(|x| x.0))
    }
}

/// Test computation: sines and cosines of the first angles, as many as fill a register.
struct InRegister<'a, T>(&'a [T]);

impl<T: Lane> Kernel<T> for InRegister<'_, T> {
    type Output = Vec<(T, T)>;

    #[inline(always)]
    fn run<R: Simd<T>>(self) -> Self::Output {
        let (sines, cosines) = R::load(self.0).unwrap().sin_cos();
        let mut all = [
            std::vec![self.0[0]; R::LANES],
            std::vec![self.0[0]; R::LANES],
        ];
        sines.store(&mut all[0]);
        cosines.store(&mut all[1]);
        let [sines, cosines] = all;
        sines.into_iter().zip(cosines).collect()
    }
}

#[test]
fn fused_f64_is_right_to_an_ulp_everywhere() {
    let reference = Reference::new();
    let mut worst = (0.0, 0.0);
    for angle in angles(4000) {
        let Ok(([sine], [cosine])) = run_fused(SinesInFused([angle])) else {
            return or_skip(InstructionSet::Avx2);
        };
        let (exact_sine, exact_cosine) = reference.sin_cos(&[angle]);
        for (value, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            let error = ulps(value, &exact, 53, -1074);
            assert!(error < 0.9, "{angle:e}: {error} ulp");
            if error > worst.0 {
                worst = (error, angle);
            }
        }
    }
    std::println!(
        "worst error of fused f64: {:.4} ulp at {:e}",
        worst.0,
        worst.1
    );
}

#[test]
fn fused_f32_is_right_to_an_ulp_everywhere() {
    let reference = Reference::new();
    let mut worst = (0.0, 0.0);
    let angles = angles(4000).into_iter().map(|angle| angle as f32);
    for angle in angles.filter(|angle| angle.is_finite()).chain([f32::MAX]) {
        let Ok(([sine], [cosine])) = run_fused(SinesInFused([angle])) else {
            return or_skip(InstructionSet::Avx2);
        };
        let (exact_sine, exact_cosine) = reference.sin_cos(&[f64::from(angle)]);
        for (value, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            let error = ulps(f64::from(value), &exact, 24, -149);
            assert!(error < 0.9, "{angle:e}: {error} ulp");
            if error > worst.0 {
                worst = (error, f64::from(angle));
            }
        }
    }
    std::println!(
        "worst error of fused f32: {:.4} ulp at {:e}",
        worst.0,
        worst.1
    );
}

/// Checks that sines are odd functions, for zeros, tiny angles, NaN, and both signs.
#[test]
fn fused_sines_are_odd() {
    for angle in signed() {
        let Ok(([sine], [cosine])) = run_fused(SinesInFused([angle])) else {
            return or_skip(InstructionSet::Avx2);
        };
        let Ok(([minus_sine], [same_cosine])) = run_fused(SinesInFused([-angle])) else {
            return or_skip(InstructionSet::Avx2);
        };
        assert_eq!(bits((-sine, cosine)), bits((minus_sine, same_cosine)));
    }
    let one = |angle: f64| run_fused(SinesInFused([angle])).ok().unwrap();
    let one_single = |angle: f32| run_fused(SinesInFused([angle])).ok().unwrap();
    assert_eq!(one(0.0).0[0].to_bits(), 0);
    assert_eq!(one(-0.0).0[0].to_bits(), (-0.0_f64).to_bits());
    assert_eq!(one_single(0.0).0[0].to_bits(), 0);
    assert_eq!(one_single(-0.0).0[0].to_bits(), (-0.0_f32).to_bits());
    let mut tiny = 2.0_f64.powi(-27);
    while tiny > 0.0 {
        assert_eq!(one(tiny), ([tiny], [1.0]));
        tiny *= 0.49;
    }
    for angle in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let ([sine], [cosine]) = one(angle);
        assert!(sine.is_nan() && cosine.is_nan());
        let ([sine], [cosine]) = one_single(angle as f32);
        assert!(sine.is_nan() && cosine.is_nan());
    }
}

fn fused_agrees<const N: usize>() {
    let all = signed();
    for &angles in all.as_chunks::<N>().0 {
        let small = angles.map(|angle| angle as f32);
        let (Ok((sines, cosines)), Ok(single)) = (
            run_fused(SinesInFused(angles)),
            run_fused(SinesInFused(small)),
        ) else {
            return or_skip(InstructionSet::Avx2);
        };
        for i in 0..N {
            let Ok(([sine], [cosine])) = run_fused(SinesInFused([angles[i]])) else {
                return or_skip(InstructionSet::Avx2);
            };
            assert_eq!(bits((sines[i], cosines[i])), bits((sine, cosine)));
            let Ok(([sine], [cosine])) = run_fused(SinesInFused([small[i]])) else {
                return or_skip(InstructionSet::Avx2);
            };
            assert_eq!(
                (single.0[i].to_bits(), single.1[i].to_bits()),
                (sine.to_bits(), cosine.to_bits())
            );
        }
    }
}

#[test]
fn one_angle_has_the_same_fused_bits_in_any_company() {
    fused_agrees::<2>();
    fused_agrees::<3>();
    fused_agrees::<4>();
    fused_agrees::<5>();
    fused_agrees::<7>();
    fused_agrees::<15>();
    fused_agrees::<31>();
}

#[test]
fn registers_have_the_bits_of_one_angle() {
    skip_missing();
    for block in signed().as_chunks::<16>().0 {
        for set in InstructionSet::ALL {
            let found = run_in_registers(set, InRegister(block));
            for (&angle, found) in block.iter().zip(found) {
                let alone = match run_fused(SinesInFused([angle])) {
                    Ok(([sine], [cosine])) if set > InstructionSet::Build => (sine, cosine),
                    _ => Scalar::sin_cos(angle),
                };
                assert_eq!(bits(found), bits(alone), "{angle:e}, {set}");
            }
            let small: Vec<f32> = block.iter().map(|angle| *angle as f32).collect();
            let found = run_in_registers(set, InRegister(&small));
            for (&angle, (sine, cosine)) in small.iter().zip(found) {
                let alone = match run_fused(SinesInFused([angle])) {
                    Ok(([sine], [cosine])) if set > InstructionSet::Build => (sine, cosine),
                    _ => Scalar::sin_cos(angle),
                };
                let alone = (alone.0.to_bits(), alone.1.to_bits());
                assert_eq!(
                    (sine.to_bits(), cosine.to_bits()),
                    alone,
                    "{angle:e}, {set}"
                );
            }
        }
    }
}

#[test]
fn tiny_angles_are_their_own_sines() {
    let mut tiny = 2.0_f64.powi(-27);
    while tiny > 0.0 {
        assert_eq!(sin_cos_f64([tiny]), ([tiny], [1.0]));
        assert_eq!(sin_cos_f64([-tiny]), ([-tiny], [1.0]));
        tiny *= 0.49;
    }
    assert_eq!(
        sin_cos_f32([f32::from_bits(1)]),
        ([f32::from_bits(1)], [1.0])
    );
}

#[test]
fn zeros_keep_their_sign_and_what_is_no_angle_gives_nan() {
    let ([sine], [cosine]) = sin_cos_f64([-0.0]);
    assert_eq!((sine.to_bits(), cosine), ((-0.0_f64).to_bits(), 1.0));
    assert_eq!(sin_cos_f64([0.0]).0[0].to_bits(), 0);
    let ([sine], [cosine]) = sin_cos_f32([-0.0]);
    assert_eq!((sine.to_bits(), cosine), ((-0.0_f32).to_bits(), 1.0));
    assert_eq!(sin_cos_f32([0.0]).0[0].to_bits(), 0);
    for angle in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let ([sine], [cosine]) = sin_cos_f64([angle]);
        assert!(sine.is_nan() && cosine.is_nan());
        let ([sine], [cosine]) = sin_cos_f32([angle as f32]);
        assert!(sine.is_nan() && cosine.is_nan());
    }
}

fn bits((sine, cosine): (f64, f64)) -> (u64, u64) {
    (sine.to_bits(), cosine.to_bits())
}

/// Returns angles of both signs, including zeros and a few large ones.
fn signed() -> Vec<f64> {
    let mut all = angles(500);
    all.push(0.0);
    all.retain(|angle| *angle < 1e5 || angle.to_bits() % 16 == 0);
    let negative: Vec<f64> = all.iter().map(|angle| -angle).collect();
    all.extend(negative);
    all
}

#[test]
fn the_functions_are_odd_and_even() {
    for angle in signed() {
        let ([sine], [cosine]) = sin_cos_f64([angle]);
        assert_eq!(
            bits((-sine, cosine)),
            bits({
                let ([sine], [cosine]) = sin_cos_f64([-angle]);
                (sine, cosine)
            })
        );
    }
}

struct InLanes<const N: usize>([f64; N]);

impl<const N: usize> Kernel<f64> for InLanes<N> {
    type Output = (Lanes<f64, N>, Lanes<f64, N>);

    #[inline(always)]
    fn run<V: Simd<f64>>(self) -> Self::Output {
        Lanes(self.0).sin_cos()
    }
}

/// Checks that an angle has the same sine and cosine alone, among others and in lanes, for every
/// instruction set.
fn agrees<const N: usize>() {
    let all = signed();
    for &angles in all.as_chunks::<N>().0 {
        let alone = angles.map(|angle| bits(Scalar::sin_cos(angle)));
        let (sines, cosines) = f64::sin_cos_each(&angles);
        assert_eq!(from_fn(|i| bits((sines[i], cosines[i]))), alone);
        for set in InstructionSet::ALL {
            let (sines, cosines) = run_wide(set, InLanes(angles));
            assert_eq!(
                from_fn(|i| bits((sines.0[i], cosines.0[i]))),
                alone,
                "{set}"
            );
        }
        let small = angles.map(|angle| angle as f32);
        let alone = small
            .map(Scalar::sin_cos)
            .map(|(s, c)| (s.to_bits(), c.to_bits()));
        let (sines, cosines) = f32::sin_cos_each(&small);
        assert_eq!(
            from_fn(|i| (sines[i].to_bits(), cosines[i].to_bits())),
            alone
        );
        let (sines, cosines) = Lanes(small).sin_cos();
        assert_eq!(
            from_fn(|i| (sines.0[i].to_bits(), cosines.0[i].to_bits())),
            alone
        );
    }
}

#[test]
fn one_angle_has_the_same_bits_in_any_company() {
    skip_missing();
    agrees::<1>();
    agrees::<2>();
    agrees::<3>();
    agrees::<4>();
    agrees::<5>();
    agrees::<7>();
    agrees::<8>();
    agrees::<15>();
    agrees::<16>();
    agrees::<31>();
}
