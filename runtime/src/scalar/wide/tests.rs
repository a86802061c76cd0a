use std::vec::Vec;

use super::Double;
use crate::scalar::reference::{Fixed, Reference, SHORT, Signed, angles};
use crate::scalar::{Real, Scalar};

/// u² = 2⁻¹⁰⁶.
const UNIT: f64 = 1.232_595_164_407_831e-32;

/// Returns the relative error in units of u².
fn units(value: Double, exact: &Signed) -> f64 {
    let part = |part: f64| Fixed::<SHORT>::of(part.abs());
    let size = if value.high.is_sign_negative() == value.low.is_sign_negative() {
        part(value.high).add(part(value.low))
    } else {
        part(value.high).sub(part(value.low))
    };
    assert_eq!(value.high.is_sign_negative(), exact.negative);
    size.distance(exact.size).to_f64() / exact.size.to_f64() / UNIT
}

#[test]
fn sine_and_cosine_are_right_to_105_bits() {
    let reference = Reference::new();
    let mut worst = (0.0, 0.0, 0.0);
    let all = angles(1500);
    let low: Vec<f64> = all
        .iter()
        .map(|angle| angle * 2.0_f64.powi(-54) * 0.77)
        .collect();
    for (&high, &low) in all.iter().zip(&low) {
        // Beyond this the second part is a large angle itself, with an absolute error.
        if high > 2.0_f64.powi(52) {
            continue;
        }
        for angle in [
            Double::of(high, 0.0),
            Double::of(high, low),
            Double::of(high, -low),
        ] {
            let (sine, cosine) = angle.sin_cos();
            let exact = reference.sin_cos(&[angle.high, angle.low]);
            for (value, exact) in [(sine, exact.0), (cosine, exact.1)] {
                let error = units(value, &exact);
                assert!(error < 4.0, "{angle:?}: {error}");
                if error > worst.0 {
                    worst = (error, angle.high, angle.low);
                }
            }
        }
    }
    std::println!("worst error of Double: {worst:?} in units of 2^-106");
}

#[test]
fn large_angles_lose_nothing_to_the_first_part() {
    let reference = Reference::new();
    for angle in angles(500)
        .into_iter()
        .filter(|angle| *angle > 2.0_f64.powi(52))
    {
        let (sine, cosine) = Double::from_f64(angle).sin_cos();
        let exact = reference.sin_cos(&[angle]);
        assert!(units(sine, &exact.0) < 4.0, "{angle:e}");
        assert!(units(cosine, &exact.1) < 4.0, "{angle:e}");
    }
}

#[test]
fn operations_undo_each_other_to_the_last_bits() {
    for angle in angles(300).into_iter().filter(|angle| *angle < 1e100) {
        let x = Double::from_f64(angle) / Double::from_f64(3.0);
        let y = Double::from_f64(0.1) * Double::from_f64(0.3);
        let near = |a: Double, b: Double| {
            let error = Real::abs((a - b) / b).high / UNIT;
            assert!(error < 32.0, "{a} and {b}: {error}");
        };
        near(x * y / y, x);
        if x > y {
            near((x + y) - y, x);
        }
        near(x.sqrt() * x.sqrt(), x);
        near(x + x + x, Double::from_f64(angle));
    }
}

#[test]
fn a_product_holds_twice_the_bits() {
    // (1 + 2⁻⁵²)² = 1 + 2⁻⁵¹ + 2⁻¹⁰⁴
    let x = Double::from_f64(1.0 + f64::EPSILON);
    let square = x * x;
    assert_eq!(square.high, 1.0 + 2.0 * f64::EPSILON);
    assert_eq!(square.low, f64::EPSILON * f64::EPSILON);
    assert_eq!(Double::sum(1.0, 1e-20).low, 1e-20);
}

#[test]
fn what_is_no_number_stays_none() {
    let (sine, cosine) = Double::from_f64(f64::INFINITY).sin_cos();
    assert!(sine.high.is_nan() && cosine.high.is_nan());
    assert!(Double::from_f64(-1.0).sqrt().high.is_nan());
    assert_eq!(Double::ZERO.sqrt(), Double::ZERO);
    assert!(Double::from_f64(-0.0).sin_cos().0.high.is_sign_negative());
}
