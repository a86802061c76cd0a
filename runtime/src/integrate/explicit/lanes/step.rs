//! Stages, sums and norms of one step in every lane.

use super::memory::{Memory, sum};
use super::pair::LanePair;
use crate::integrate::explicit::Span;
use crate::integrate::lanes::Models;
use crate::integrate::sum::two_sum;
use crate::model::Part;
use crate::scalar::register::Register;
use crate::system::Cast;
use crate::system::cast::{at, put};

/// The right-hand sides of the pendulums: angles, then velocities.
///
/// In a function of its own, which all stages call: equations of large trees
/// are long.
impl<'a, P: Cast<R::Lane>, R: Register> Part<0, (R, &'a [R], &'a mut [R])> for Models<P, R> {
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
        self.registers.evaluate(
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
    pub(super) fn evaluate<P: Cast<R::Lane>>(
        &mut self,
        models: &Models<P, R>,
        time: R,
        stage: usize,
    ) {
        let n = 2 * P::LINKS;
        let rates = &mut self.rates[(stage - 1) * n..][..n];
        R::outlined::<0, _, _>(models, (time, self.stage.as_slice(), &mut *rates));
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

    /// Stage `STAGE` of a step.
    #[inline(always)]
    pub(in crate::integrate::explicit) fn make_stage<M, P, const STAGE: usize>(
        &mut self,
        models: &Models<P, R>,
        span: Span<R>,
    ) where
        M: LanePair,
        P: Cast<R::Lane>,
    {
        let (row, fraction) = const { (M::ROWS[STAGE - 2], M::NODES[STAGE - 1]) };
        let n = 2 * P::LINKS;
        let (start, values) = (&self.start[..n], &mut self.stage[..n]);
        let rates = &self.rates[..M::STAGES_DENSE * n];
        for i in 0..n {
            values[i] = span.step.mul_add(sum(row, rates, n, i), start[i]);
        }
        self.evaluate(models, node(span, fraction), STAGE);
    }

    /// All stages, the end of the step and the rates there. Returns a number
    /// that is zero in the lanes whose end is finite, and NaN in others.
    #[inline(always)]
    pub(super) fn step<M: LanePair, P: Cast<R::Lane>>(
        &mut self,
        models: &Models<P, R>,
        span: Span<R>,
        compensated: bool,
    ) -> R {
        M::stages_in_lanes(self, models, span);
        let weights = const { M::ROWS[M::STAGES - 1] };
        let n = 2 * P::LINKS;
        let (start, end) = (&self.start[..n], &mut self.end[..n]);
        let rates = &self.rates[..M::STAGES_DENSE * n];
        if compensated {
            let (residue, rest) = (&self.start_residue[..n], &mut self.end_residue[..n]);
            for i in 0..n {
                let change = span.step.mul_add(sum(weights, rates, n, i), residue[i]);
                (end[i], rest[i]) = two_sum(start[i], change);
            }
        } else {
            for i in 0..n {
                end[i] = span.step.mul_add(sum(weights, rates, n, i), start[i]);
            }
        }
        let mut check = R::from_f64(0.0);
        for (value, stage) in end.iter().zip(&mut self.stage) {
            check = value.mul_add(R::from_f64(0.0), check);
            *stage = *value;
        }
        self.evaluate(models, span.time + span.step, M::STAGES + 1);
        check
    }

    /// One over the tolerance of component i for an error of the step.
    #[inline(always)]
    pub(in crate::integrate::explicit) fn inverse_scale(&self, i: usize) -> R {
        let largest = self.start[i].larger_size(self.end[i]);
        R::from_f64(1.0) / self.relative[i].mul_add(largest, self.absolute[i])
    }

    /// Root mean square over the components of h (sum of row)/tolerance, `size`
    /// being the lengths of the steps.
    #[inline(always)]
    pub(in crate::integrate::explicit) fn mean_square_error<M: LanePair>(
        &self,
        row: &[(usize, f64)],
        n: usize,
        size: R,
    ) -> R {
        let rates = &self.rates[..M::STAGES_DENSE * n];
        let mut squares = R::from_f64(0.0);
        for i in 0..n {
            let ratio = sum(row, rates, n, i) * self.inverse_scale(i);
            squares = ratio.mul_add(ratio, squares);
        }
        size * (squares / R::from_f64(n as f64)).sqrt()
    }

    /// Coefficients of a dense output by Dormand and Prince: Δy, h k₁ − Δy, what is
    /// left of h k at the end, and h (sum of row) for each of `rows`.
    #[inline(always)]
    pub(in crate::integrate::explicit) fn dense_by_rates<M: LanePair>(
        &mut self,
        rows: &[&[(usize, f64)]],
        n: usize,
        span: Span<R>,
    ) {
        let rates = &self.rates[..M::STAGES_DENSE * n];
        let (low, high) = self.dense.split_at_mut(3 * n);
        for i in 0..n {
            let increment = self.end[i] - self.start[i];
            let left = span.step * rates[i] - increment;
            let right = increment - span.step * rates[M::STAGES * n + i] - left;
            low[i] = increment;
            low[n + i] = left;
            low[2 * n + i] = right;
        }
        for (row, coefficients) in rows.iter().zip(high.chunks_exact_mut(n)) {
            for (i, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient = span.step * sum(row, rates, n, i);
            }
        }
    }

    /// y + s (d₁ + r (d₂ + s (d₃ + …))), r = 1 − s.
    #[inline(always)]
    pub(in crate::integrate::explicit) fn alternate<M: LanePair>(&self, s: R, out: &mut [R]) {
        let n = self.start.len();
        let r = R::from_f64(1.0) - s;
        let (inner, outer) = if M::DENSE_TERMS % 2 == 1 {
            (s, r)
        } else {
            (r, s)
        };
        for (i, (out, &start)) in out.iter_mut().zip(&self.start).enumerate() {
            // From the highest term on, times s and r in turn.
            let mut terms = self.dense.chunks_exact(n).rev();
            let mut value = terms.next().map_or(start, |term| term[i]);
            let (mut factor, mut other) = (inner, outer);
            for term in terms {
                value = factor.mul_add(value, term[i]);
                (factor, other) = (other, factor);
            }
            *out = factor.mul_add(value, start);
        }
    }
}

/// `make_stages!(memory, models, span: 2, 3);` makes these stages of the pair `Self`
/// for pendulums `P`, each with its row written out.
macro_rules! make_stages {
    ($memory:ident, $models:ident, $span:ident: $($stage:literal),+) => {
        $($memory.make_stage::<Self, P, $stage>($models, $span);)+
    };
}
pub(in crate::integrate::explicit) use make_stages;
