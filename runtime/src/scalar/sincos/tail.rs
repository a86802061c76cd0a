//! Higher-order terms of sine and cosine, as polynomials in the square of the angle.
//!
//! Horner's scheme takes five consecutive products for degree five. With adapted coefficients (D.
//! E. Knuth, The Art of Computer Programming 2, 3rd ed. 1997, §4.6.4) it takes four products, three
//! of which depend on each other. Their rounding errors are larger: too large for the sine, of
//! which this part is a tenth, but negligible for the cosine, of which it is a fiftieth.

// As for the registers.
#![allow(unreachable_pub)]

use super::fused::FusingNumber;

/// Builds an array from an expression for each index. It expands to a plain loop, because closures
/// are not guaranteed to be compiled for the vector instructions of the surrounding function.
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

/// A polynomial, together with its method of evaluation.
#[derive(Clone, Copy, Debug)]
pub enum Tail<T> {
    /// Degree two, by Horner's scheme; coefficients from the constant term on.
    Short([T; 3]),
    /// Degree five, by Horner's scheme; coefficients from the constant term on.
    Long([T; 6]),
    /// Degree five, as t + y (u + y (v + w x)) with y = x (x + b) + c.
    Nested(Nested<T>),
}

/// Adapted coefficients of a polynomial of degree five.
#[derive(Clone, Copy, Debug)]
pub struct Nested<T> {
    pub b: T,
    pub c: T,
    pub t: T,
    pub u: T,
    pub v: T,
    pub w: T,
}

/// The polynomial (cos √x − 1 + x/2) / x² for √x ≤ π/4, from FDLIBM; the cosine's error is up to
/// 2⁻⁵⁹.
pub(super) const COSINE: Tail<f64> = Tail::Nested(Nested {
    b: -80.585_464_319_516_05,
    c: 7_061.240_596_009_447,
    t: -1.760_217_340_844_006_2e-2,
    u: 6.580_731_146_463_145e-6,
    v: 2.567_273_753_973_384e-10,
    w: -1.135_964_755_778_819_5e-11,
});

/// Evaluates the polynomial `tail` at several squares of angles.
#[inline(always)]
pub(super) fn evaluate<P: FusingNumber, const G: usize>(x: [P; G], tail: Tail<P::Lane>) -> [P; G] {
    match tail {
        Tail::Short([a, b, c]) => {
            let (a, b, c) = (P::splat(a), P::splat(b), P::splat(c));
            let value = for_each!(a; i => x[i].mul_add(c, b));
            for_each!(a; i => x[i].mul_add(value[i], a))
        }
        Tail::Long([a, b, c, d, e, f]) => {
            let (a, b, c) = (P::splat(a), P::splat(b), P::splat(c));
            let (d, e, f) = (P::splat(d), P::splat(e), P::splat(f));
            let value = for_each!(a; i => x[i].mul_add(f, e));
            let value = for_each!(a; i => x[i].mul_add(value[i], d));
            let value = for_each!(a; i => x[i].mul_add(value[i], c));
            let value = for_each!(a; i => x[i].mul_add(value[i], b));
            for_each!(a; i => x[i].mul_add(value[i], a))
        }
        Tail::Nested(Nested { b, c, t, u, v, w }) => {
            let (b, c, t) = (P::splat(b), P::splat(c), P::splat(t));
            let (u, v, w) = (P::splat(u), P::splat(v), P::splat(w));
            let y = for_each!(b; i => x[i].mul_add(x[i] + b, c));
            let line = for_each!(b; i => x[i].mul_add(w, v));
            let inner = for_each!(b; i => y[i].mul_add(line[i], u));
            for_each!(b; i => y[i].mul_add(inner[i], t))
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_4;

    use super::{COSINE, Tail};
    use crate::scalar::{Double, Scalar};

    /// Compared with the function itself.
    #[test]
    fn adapted_coefficients_give_the_cosine() {
        let Tail::Nested(nested) = COSINE else {
            panic!("coefficients are not adapted");
        };
        let number = Double::from_f64;
        for step in 1..=1000 {
            let angle = number(f64::from(step) / 1000.0 * FRAC_PI_4);
            let x = angle * angle;
            let y = x * (x + number(nested.b)) + number(nested.c);
            let line = number(nested.v) + x * number(nested.w);
            let tail = number(nested.t) + y * (number(nested.u) + y * line);
            let found = number(1.0) - number(0.5) * x + x * x * tail;
            let cosine = angle.sin_cos().1;
            let error = ((found - cosine) / cosine).high().abs();
            assert!(error < 2.0_f64.powi(-59), "cosine of {angle}: {error:e}");
        }
    }
}
