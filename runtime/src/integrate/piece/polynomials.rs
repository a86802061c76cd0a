//! Polynomials between the two ends of a step, for numbers of any width.

// One index runs through several vectors at once.
#![allow(clippy::needless_range_loop)]

use super::Lift;
use crate::scalar::Scalar;

/// Degree of the Bernstein polynomials.
pub(in crate::integrate) const DEGREE: usize = 8;

/// Returns component i (of n) of y + s (d₀ + r (d₁ + s (d₂ + …))), with r = 1 − s, the start y and
/// the terms d.
#[inline(always)]
pub(in crate::integrate) fn alternating<W: Scalar, S: Lift<W>>(
    s: S,
    start: W,
    terms: &[W],
    n: usize,
    i: usize,
) -> S {
    let r = S::from_f64(1.0) - s;
    let count = terms.len() / n;
    let (mut factor, mut other) = if count % 2 == 1 { (s, r) } else { (r, s) };
    // From the highest term down, multiplied by s and r alternately.
    let mut value = S::lift(terms[(count - 1) * n + i]);
    for k in (0..count - 1).rev() {
        value = factor.mul_add(value, S::lift(terms[k * n + i]));
        (factor, other) = (other, factor);
    }
    factor.mul_add(value, S::lift(start))
}

/// Returns component i (of n) of y + Σ_k d_k b_k(s), with the start y, the terms d and the weights
/// b_k(s).
#[inline(always)]
pub(in crate::integrate) fn blend<W: Scalar, S: Lift<W>>(
    weights: &[S; DEGREE],
    start: W,
    terms: &[W],
    n: usize,
    i: usize,
) -> S {
    let mut value = S::from_f64(0.0);
    for k in 0..DEGREE {
        value = weights[k].mul_add(S::lift(terms[k * n + i]), value);
    }
    S::lift(start) + value
}

/// Returns the Bernstein polynomials 1 to 8 of degree 8 at s.
#[inline(always)]
pub(in crate::integrate) fn bernstein<W: Scalar>(s: W) -> [W; DEGREE] {
    let [zero, one] = [0.0, 1.0].map(W::from_f64);
    let r = one - s;
    let mut row = [zero; DEGREE + 1];
    row[0] = one;
    for degree in 1..=DEGREE {
        for k in (1..=degree).rev() {
            row[k] = r * row[k] + s * row[k - 1];
        }
        row[0] = r * row[0];
    }
    let mut inner = [zero; DEGREE];
    inner.copy_from_slice(&row[1..]);
    inner
}

/// Returns y + s (Δy + r (d₁ + s (d₂ − d₁))), r = 1 − s, with d₁ = h k₀ − Δy and d₂ = Δy − h k₁,
/// for one component: the cubic through both ends of a step of length h with the rates k₀ and k₁
/// there.
#[inline(always)]
pub(in crate::integrate) fn hermite<W: Scalar, S: Lift<W>>(
    s: S,
    length: W,
    [start, end]: [W; 2],
    [first, last]: [W; 2],
) -> S {
    let r = S::from_f64(1.0) - s;
    let increment = end - start;
    let left = length * first - increment;
    let right = increment - length * last;
    let bend = S::lift(left) + s * S::lift(right - left);
    S::lift(start) + s * (S::lift(increment) + r * bend)
}
