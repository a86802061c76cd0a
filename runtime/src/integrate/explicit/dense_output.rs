//! Values inside a step of an explicit pair.

// One index into all components at once.
#![allow(clippy::needless_range_loop)]

use super::pair::{DenseForm, EmbeddedPair};
use super::stages::{RightHandSide, StepSpan, StepStages, sum, terms};
use crate::integrate::piece::Lift;
use crate::scalar::Scalar;

/// Degree of [`DenseForm::Bernstein`].
const DEGREE: usize = 8;

impl<W: Scalar> StepStages<W> {
    /// The stages and the coefficients of the dense output of a step.
    #[inline(always)]
    pub(super) fn prepare_dense<M: EmbeddedPair, S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        span: StepSpan<W>,
    ) -> Result<(), S::Failure> {
        self.make_dense::<M, S>(system, span)?;
        let n = system.dimension();
        match M::DENSE {
            DenseForm::Alternating(_) => self.hermite::<M>(n, span.step),
            DenseForm::Bernstein(_) => self.end_terms::<M>(n, span.step),
        }
        self.row_terms::<M, 0>(n, span.step);
        self.row_terms::<M, 1>(n, span.step);
        self.row_terms::<M, 2>(n, span.step);
        self.row_terms::<M, 3>(n, span.step);
        self.row_terms::<M, 4>(n, span.step);
        Ok(())
    }

    /// h (sum of row) for row `ROW` of the dense output, if there are so many.
    #[inline(always)]
    fn row_terms<M: EmbeddedPair, const ROW: usize>(&mut self, n: usize, step: W) {
        const { assert!(M::DENSE.rows().len() <= 5) }
        let row = const {
            let rows = M::DENSE.rows();
            if ROW < rows.len() { rows[ROW] } else { &[] }
        };
        if row.is_empty() {
            return;
        }
        let place = (M::DENSE.terms_before_rows() + ROW) * n;
        let coefficients = &mut self.dense[place..][..n];
        let terms = terms(row, &self.rates, n);
        for i in 0..n {
            coefficients[i] = step * sum(row, &terms, i);
        }
    }

    /// The first three coefficients of [`DenseForm::Alternating`].
    #[inline(always)]
    fn hermite<M: EmbeddedPair>(&mut self, n: usize, step: W) {
        let (start, end) = (&self.start[..n], &self.end[..n]);
        let (first, last) = (&self.rates[..n], &self.rates[M::STAGES * n..][..n]);
        let dense = &mut self.dense[..3 * n];
        for i in 0..n {
            let increment = end[i] - start[i];
            let left = step * first[i] - increment;
            dense[i] = increment;
            dense[n + i] = left;
            dense[2 * n + i] = increment - step * last[i] - left;
        }
    }

    /// The first and the last two coefficients of [`DenseForm::Bernstein`].
    #[inline(always)]
    fn end_terms<M: EmbeddedPair>(&mut self, n: usize, step: W) {
        let part = step / W::from_f64(DEGREE as f64);
        let (start, end) = (&self.start[..n], &self.end[..n]);
        let (first, last) = (&self.rates[..n], &self.rates[M::STAGES * n..][..n]);
        let dense = &mut self.dense[..DEGREE * n];
        for i in 0..n {
            let increment = end[i] - start[i];
            dense[i] = part * first[i];
            dense[(DEGREE - 2) * n + i] = increment - part * last[i];
            dense[(DEGREE - 1) * n + i] = increment;
        }
    }

    /// Writes the solution at the fraction `s` of the step.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(super) fn value<M: EmbeddedPair>(&self, s: W, out: &mut [W]) {
        let n = self.start.len();
        match M::DENSE {
            DenseForm::Alternating(_) => {
                for i in 0..n {
                    out[i] = alternating(s, self.start[i], &self.dense, n, i);
                }
            }
            DenseForm::Bernstein(_) => {
                let weights = bernstein(s);
                for i in 0..n {
                    out[i] = blend(&weights, self.start[i], &self.dense, n, i);
                }
            }
        }
    }
}

/// y + s (d₀ + r (d₁ + s (d₂ + …))), r = 1 − s, for component i of n.
#[inline(always)]
pub(crate) fn alternating<W: Scalar, S: Lift<W>>(
    s: S,
    start: W,
    terms: &[W],
    n: usize,
    i: usize,
) -> S {
    let r = S::from_f64(1.0) - s;
    let count = terms.len() / n;
    let (mut factor, mut other) = if count % 2 == 1 { (s, r) } else { (r, s) };
    // From the highest term on, times s and r in turn.
    let mut value = S::lift(terms[(count - 1) * n + i]);
    for k in (0..count - 1).rev() {
        value = factor.mul_add(value, S::lift(terms[k * n + i]));
        (factor, other) = (other, factor);
    }
    factor.mul_add(value, S::lift(start))
}

/// y + Σ_k d_k b_k(s) for component i of n, the b_k(s) being these weights.
#[inline(always)]
pub(crate) fn blend<W: Scalar, S: Lift<W>>(
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

/// Bernstein polynomials 1 to 8 of degree 8.
#[inline(always)]
pub(crate) fn bernstein<W: Scalar>(s: W) -> [W; DEGREE] {
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
