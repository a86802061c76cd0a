//! What sines and cosines have beside their first terms: polynomials in the square
//! of the angle.
//!
//! Horner's scheme takes five products for degree five, one after the other. With
//! adapted coefficients (D. E. Knuth, The Art of Computer Programming 2, 3rd ed.
//! 1997, §4.6.4) it is four, and four operations after each other: sums take their
//! place, for which processors have units of their own.

// As for the registers.
#![allow(unreachable_pub)]

use super::fused::Pack;

/// An array of what the expression gives for each index: a plain loop, because
/// closures are not sure to be compiled for the surrounding instructions.
macro_rules! for_each {
    ($zero:expr; $i:ident => $value:expr) => {{
        let mut values = [$zero; G];
        for $i in 0..G {
            values[$i] = $value;
        }
        values
    }};
}
pub(super) use for_each;

/// A polynomial.
#[derive(Clone, Copy, Debug)]
pub enum Tail<T> {
    /// p₀ + p₁ x + p₂ x², by Horner's scheme.
    Short([T; 3]),
    /// Degree five, as t + y (u + y (v + w x)) with y = x (x + b) + c.
    Nested(Nested<T>),
    /// The same with y + shift in place of the inner y: one sum more, and smaller
    /// rounding errors where t is small then.
    Shifted(Nested<T>, T),
}

/// Adapted coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Nested<T> {
    pub b: T,
    pub c: T,
    pub t: T,
    pub u: T,
    pub v: T,
    pub w: T,
}

/// (sin √x / √x − 1) / x for √x ≤ π/4, up to 2⁻⁵⁷·⁹ of the sine: FDLIBM's polynomial,
/// with the b for which rounding errors have the least bound.
pub(super) const SINE: Tail<f64> = Tail::Shifted(
    Nested {
        b: -78.5625,
        c: 2_768.709_172_846_189_6,
        t: -2.631_410_982_123_178e-3,
        u: -5.864_074_156_193_496e-5,
        v: -7.274_049_114_538_244e-11,
        w: 1.589_690_995_211_55e-10,
    },
    5_553.631_346_105_261,
);

/// (cos √x − 1 + x/2) / x² for √x ≤ π/4, up to 2⁻⁵⁹ of the cosine: FDLIBM's polynomial.
pub(super) const COSINE: Tail<f64> = Tail::Nested(Nested {
    b: -14.900_981_867_561_343,
    c: 9_724.168_422_042_349,
    t: 1.667_967_001_575_622_7e-3,
    u: -1.289_455_821_121_382_7e-5,
    v: 1.749_032_516_737_196e-9,
    w: -1.135_964_755_778_819_5e-11,
});

/// The values for some squares of angles.
#[inline(always)]
pub(super) fn evaluate<P: Pack, const G: usize>(x: [P; G], tail: Tail<P::Lane>) -> [P; G] {
    let (nested, shift) = match tail {
        Tail::Short([a, b, c]) => {
            let (a, b, c) = (P::splat(a), P::splat(b), P::splat(c));
            let high = for_each!(a; i => x[i].mul_add(c, b));
            return for_each!(a; i => x[i].mul_add(high[i], a));
        }
        Tail::Nested(nested) => (nested, None),
        Tail::Shifted(nested, shift) => (nested, Some(shift)),
    };
    let Nested { b, c, t, u, v, w } = nested;
    let (b, c, t) = (P::splat(b), P::splat(c), P::splat(t));
    let (u, v, w) = (P::splat(u), P::splat(v), P::splat(w));
    let y = for_each!(b; i => x[i].mul_add(x[i] + b, c));
    let inner = match shift {
        Some(shift) => for_each!(b; i => y[i] + P::splat(shift)),
        None => y,
    };
    let line = for_each!(b; i => x[i].mul_add(w, v));
    let inner = for_each!(b; i => inner[i].mul_add(line[i], u));
    for_each!(b; i => y[i].mul_add(inner[i], t))
}

#[cfg(test)]
mod tests {
    use super::{COSINE, SINE, Tail};
    use crate::scalar::{Double, Scalar};

    fn adapted(tail: Tail<f64>, x: Double) -> Double {
        let number = Double::from_f64;
        let (nested, shift) = match tail {
            Tail::Short([a, b, c]) => return number(a) + x * (number(b) + x * number(c)),
            Tail::Nested(nested) => (nested, 0.0),
            Tail::Shifted(nested, shift) => (nested, shift),
        };
        let y = x * (x + number(nested.b)) + number(nested.c);
        let line = number(nested.v) + x * number(nested.w);
        number(nested.t) + y * (number(nested.u) + (y + number(shift)) * line)
    }

    /// Against the functions themselves, by the sine and cosine of `Double`.
    #[test]
    fn adapted_polynomials_are_sines_and_cosines() {
        let one = Double::from_f64(1.0);
        for step in 1..=1000 {
            let angle = Double::from_f64(f64::from(step) / 1000.0 * 0.7854);
            let x = angle * angle;
            let (sine, cosine) = angle.sin_cos();
            let found = angle + angle * x * adapted(SINE, x);
            let error = ((found - sine) / sine).high().abs();
            assert!(error < 2.0_f64.powf(-57.9), "sine of {angle}: {error:e}");
            let found = one - Double::from_f64(0.5) * x + x * x * adapted(COSINE, x);
            let error = ((found - cosine) / cosine).high().abs();
            assert!(error < 2.0_f64.powi(-59), "cosine of {angle}: {error:e}");
        }
    }
}
