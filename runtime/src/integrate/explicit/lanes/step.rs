//! One step of Dormand and Prince's method of order 8(5,3) in every lane.

use super::memory::{Memory, sum};
use crate::integrate::explicit::arithmetic::{Row, Span};
use crate::integrate::explicit::dop853::B_MINUS_THIRD;
use crate::integrate::explicit::dop853::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A14, A15, A16, B, C, D, E_FIFTH, STAGES,
    STAGES_DENSE,
};
use crate::integrate::sum::two_sum;
use crate::model::Part;
use crate::scalar::register::Register;
use crate::system::Rescale;
use crate::system::rescale::{at, put};

/// The right-hand side of a pendulum in registers: angles, then velocities.
pub(super) struct Rates<P>(pub(super) P);

/// In a function of its own, which all stages call: equations of large trees
/// are long.
impl<'a, R: Register, P: Rescale<R>> Part<0, (R, &'a [R], &'a mut [R])> for Rates<P> {
    type Output = ();

    #[inline(always)]
    fn part(&self, (time, state, rates): (R, &'a [R], &'a mut [R])) {
        // As many as the compiler knows them to be.
        let (Some(state), Some(rates)) = (state.get(..2 * P::LINKS), rates.get_mut(..2 * P::LINKS))
        else {
            return;
        };
        let (theta, omega) = state.split_at(P::LINKS);
        let (velocities, alpha) = rates.split_at_mut(P::LINKS);
        for (rate, velocity) in velocities.iter_mut().zip(omega) {
            *rate = *velocity;
        }
        self.0.evaluate(
            time,
            |link| at(theta, link),
            |link| at(omega, link),
            |link, value| put(alpha, link, value),
        );
    }
}

/// Time at the fraction `node` of the steps.
#[inline(always)]
pub(super) fn node<R: Register>(span: Span<R>, node: f64) -> R {
    R::from_f64(node).mul_add(span.step, span.time)
}

impl<R: Register> Memory<R> {
    /// Evaluates the rates at [`stage`](Self::stage): those of stage `stage`,
    /// counted from 1.
    #[inline(always)]
    pub(super) fn evaluate<P: Rescale<R>>(&mut self, model: &Rates<P>, time: R, stage: usize) {
        let n = 2 * P::LINKS;
        let rates = &mut self.rates[(stage - 1) * n..][..n];
        R::outlined::<0, _, _>(model, (time, self.stage.as_slice(), &mut *rates));
        let zero = R::from_f64(0.0);
        let mut check = if stage > 2 {
            self.checks[stage - 2]
        } else {
            zero
        };
        for rate in rates {
            // Infinity times zero is NaN.
            check = rate.mul_add(zero, check);
        }
        self.checks[stage - 1] = check;
    }

    #[inline(always)]
    fn stage<P: Rescale<R>, const N: usize>(
        &mut self,
        model: &Rates<P>,
        span: Span<R>,
        stage: usize,
        row: &Row<N>,
    ) {
        let n = 2 * P::LINKS;
        let (start, values) = (&self.start[..n], &mut self.stage[..n]);
        let rates = &self.rates[..STAGES_DENSE * n];
        for i in 0..n {
            values[i] = span.step.mul_add(sum(row, rates, n, i), start[i]);
        }
        self.evaluate(model, node(span, C[stage - 1]), stage);
    }

    /// All stages, the end of the step and the rates there. Returns a number
    /// that is zero in the lanes whose end is finite, and NaN in others.
    #[inline(always)]
    pub(super) fn step<P: Rescale<R>>(
        &mut self,
        model: &Rates<P>,
        span: Span<R>,
        compensated: bool,
    ) -> R {
        self.stage(model, span, 2, &A2);
        self.stage(model, span, 3, &A3);
        self.stage(model, span, 4, &A4);
        self.stage(model, span, 5, &A5);
        self.stage(model, span, 6, &A6);
        self.stage(model, span, 7, &A7);
        self.stage(model, span, 8, &A8);
        self.stage(model, span, 9, &A9);
        self.stage(model, span, 10, &A10);
        self.stage(model, span, 11, &A11);
        self.stage(model, span, 12, &A12);
        let n = 2 * P::LINKS;
        let (start, end) = (&self.start[..n], &mut self.end[..n]);
        let rates = &self.rates[..STAGES_DENSE * n];
        if compensated {
            let (residue, rest) = (&self.start_residue[..n], &mut self.end_residue[..n]);
            for i in 0..n {
                let change = span.step.mul_add(sum(&B, rates, n, i), residue[i]);
                (end[i], rest[i]) = two_sum(start[i], change);
            }
        } else {
            for i in 0..n {
                end[i] = span.step.mul_add(sum(&B, rates, n, i), start[i]);
            }
        }
        let mut check = R::from_f64(0.0);
        for (value, stage) in end.iter().zip(&mut self.stage) {
            check = value.mul_add(R::from_f64(0.0), check);
            *stage = *value;
        }
        self.evaluate(model, span.time + span.step, STAGES + 1);
        check
    }

    /// The stages and coefficients of the dense output.
    #[inline(always)]
    pub(super) fn dense<P: Rescale<R>>(&mut self, model: &Rates<P>, span: Span<R>) {
        self.stage(model, span, 14, &A14);
        self.stage(model, span, 15, &A15);
        self.stage(model, span, 16, &A16);
        let n = 2 * P::LINKS;
        let rates = &self.rates[..STAGES_DENSE * n];
        let (low, high) = self.dense.split_at_mut(3 * n);
        for i in 0..n {
            let increment = self.end[i] - self.start[i];
            let left = span.step * rates[i] - increment;
            let right = increment - span.step * rates[STAGES * n + i] - left;
            low[i] = increment;
            low[n + i] = left;
            low[2 * n + i] = right;
        }
        for (row, coefficients) in D.iter().zip(high.chunks_exact_mut(n)) {
            for (i, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient = span.step * sum(row, rates, n, i);
            }
        }
    }

    /// The solutions at these fractions of the steps, as
    /// [`Dop853`](crate::integrate::Dop853) has them.
    #[inline(always)]
    pub(super) fn dense_output(&self, s: R, out: &mut [R]) {
        let n = self.start.len();
        let r = R::from_f64(1.0) - s;
        for (i, (out, &start)) in out.iter_mut().zip(&self.start).enumerate() {
            // From the highest term on, times s and r in turn.
            let mut terms = self.dense.chunks_exact(n).rev();
            let mut value = terms.next().map_or(start, |term| term[i]);
            let (mut factor, mut other) = (s, r);
            for term in terms {
                value = factor.mul_add(value, term[i]);
                (factor, other) = (other, factor);
            }
            *out = factor.mul_add(value, start);
        }
    }

    /// Scaled error of the step of `n` components: one is the largest allowed.
    /// As in the plain method (Solving ODEs I, section II.10, eq. (10.17)),
    /// `size` being the lengths of the steps.
    #[inline(always)]
    pub(super) fn error(&self, n: usize, size: R) -> R {
        let (start, end) = (&self.start[..n], &self.end[..n]);
        let (relative, absolute) = (&self.relative[..n], &self.absolute[..n]);
        let rates = &self.rates[..STAGES_DENSE * n];
        let (mut fifth, mut third) = (R::from_f64(0.0), R::from_f64(0.0));
        for i in 0..n {
            let largest = start[i].larger_size(end[i]);
            let inverse = R::from_f64(1.0) / relative[i].mul_add(largest, absolute[i]);
            let ratio = sum(&E_FIFTH, rates, n, i) * inverse;
            fifth = ratio.mul_add(ratio, fifth);
            let ratio = sum(&B_MINUS_THIRD, rates, n, i) * inverse;
            third = ratio.mul_add(ratio, third);
        }
        let mixed = R::from_f64(0.01).mul_add(third, fifth);
        // No error at all: zero over any number.
        let mixed = mixed.larger_size(self.smallest);
        size * fifth / (R::from_f64(n as f64) * mixed).sqrt()
    }
}

/// The row of a stage that is not the first.
pub(super) fn row(stage: usize) -> &'static [(usize, f64)] {
    const ROWS: [&[(usize, f64)]; STAGES_DENSE - 1] = [
        &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &A12, &B, &A14, &A15, &A16,
    ];
    ROWS[stage - 2]
}
