//! Dense output of explicit Runge–Kutta pairs: the solution within a step.

// One index runs through several vectors at once.
#![allow(clippy::needless_range_loop)]

use super::pair::{DenseForm, EmbeddedPair};
use super::stages::{StepStages, sum, terms};
use crate::integrate::piece::DEGREE;
#[cfg(feature = "std")]
use crate::integrate::piece::{alternating, bernstein, blend};
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::scalar::Scalar;

impl<W: Scalar> StepStages<W> {
    /// Evaluates the additional stages for the dense output of a step, and computes its
    /// coefficients.
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

    /// Computes coefficient number `ROW` of the dense output, h · Σ (row · rates), if the pair has
    /// such a row.
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

    /// Computes the first three coefficients of the dense output in the form
    /// [`DenseForm::Alternating`].
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

    /// Computes the first and the last two coefficients of the dense output in the form
    /// [`DenseForm::Bernstein`].
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

    /// Writes the solution at the fraction `s` (0 to 1) of the step to `out`.
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
