//! Explicit Runge–Kutta pairs in the lanes of vector registers.

mod first;
mod memory;
mod step;
#[cfg(test)]
mod tests;

use alloc::vec::Vec;

use self::memory::{Memory, sum};
use self::step::{Rates, node, row};
use super::arithmetic::Span;
use super::dop853::tables::{C, STAGES, STAGES_DENSE};
use super::pair::Pair;
use super::{Dop853, DormandPrince8};
use crate::integrate::control::StepControl;
use crate::integrate::lanes::registers::{Numbers, WIDEST, numbers, numbers_in};
use crate::integrate::lanes::{Flags, LaneMethod, Runs, Stepper};
use crate::integrate::options::Options;
use crate::scalar::register::Register;
use crate::scalar::{Lane, Real};
use crate::system::{Rescale, State};

impl<P: Rescale<T>, T: Lane> LaneMethod<P, T> for Dop853<T> {
    type Stepper<'a, R: Register<Lane = T>> = Lanes<'a, P, R>;

    fn options(&self) -> &Options<T> {
        &self.options
    }

    fn stepper<'a, R: Register<Lane = T>>(&'a self, pendulum: &P) -> Lanes<'a, P, R> {
        let zero = [T::ZERO; WIDEST];
        let control = StepControl::new(DormandPrince8::CONTROL, self.options.beta);
        Lanes {
            rates: Rates(pendulum.rescale(R::splat)),
            options: &self.options,
            memory: Memory::new(&self.options, 2 * P::LINKS),
            controls: core::array::from_fn(|_| control.clone()),
            errors: zero,
            finite_stages: zero,
            finite_end: zero,
            finite_end_rates: zero,
        }
    }
}

/// The method at work.
pub struct Lanes<'a, P: Rescale<R::Lane>, R: Register> {
    rates: Rates<P::Of<R>>,
    options: &'a Options<R::Lane>,
    memory: Memory<R>,
    controls: [StepControl<R::Lane>; WIDEST],
    /// Scaled errors of the step.
    errors: Numbers<R::Lane>,
    // Zero where finite, and NaN where not.
    /// The rates of the stages, without those at the end.
    finite_stages: Numbers<R::Lane>,
    /// The state at the end.
    finite_end: Numbers<R::Lane>,
    /// The rates there.
    finite_end_rates: Numbers<R::Lane>,
}

impl<P: Rescale<R::Lane>, R: Register> Stepper<R> for Lanes<'_, P, R> {
    fn set(&mut self, lane: usize, values: Option<&[R::Lane]>) {
        self.memory.set(lane, values);
        self.controls[lane] = StepControl::new(DormandPrince8::CONTROL, self.options.beta);
    }

    fn start(&self) -> &[R] {
        &self.memory.start
    }

    fn end(&self) -> &[R] {
        &self.memory.end
    }

    #[inline(always)]
    fn prepare(&mut self, runs: &mut Runs<R::Lane>, fresh: &Flags) {
        if fresh.contains(&true) {
            self.first_steps(runs, fresh);
        }
    }

    #[inline(always)]
    fn attempt(&mut self, span: Span<R>, size: R) {
        let memory = &mut self.memory;
        self.finite_end = numbers(memory.step(&self.rates, span, self.options.compensated));
        self.errors = numbers(memory.error(2 * P::LINKS, size));
        self.finite_stages = numbers(memory.checks[STAGES - 1]);
        self.finite_end_rates = numbers(memory.checks[STAGES]);
    }

    #[inline(always)]
    fn judge(&mut self, runs: &mut Runs<R::Lane>) -> Flags {
        let mut accepted = [false; WIDEST];
        for (lane, accepted) in accepted.iter_mut().enumerate().take(R::LANES) {
            if runs.active[lane] {
                *accepted = self.judge_lane(runs, lane);
            }
        }
        runs.count(R::LANES, &accepted);
        accepted
    }

    #[inline(always)]
    fn prepare_dense(&mut self, span: Span<R>) {
        self.memory.dense(&self.rates, span);
    }

    fn judge_dense(
        &self,
        runs: &mut Runs<R::Lane>,
        lane: usize,
    ) -> Result<(), (R::Lane, Vec<R::Lane>)> {
        if numbers(self.memory.checks[STAGES_DENSE - 1])[lane].is_finite() {
            runs.evaluations[lane] += (STAGES_DENSE - STAGES - 1) as u64;
            return Ok(());
        }
        Err(self.failed_stage(lane, runs.span(lane), STAGES_DENSE))
    }

    #[inline(always)]
    fn value(&self, fraction: R, out: &mut [R]) {
        self.memory.dense_output(fraction, out);
    }

    #[inline(always)]
    fn advance(&mut self, accepted: R::Mask) {
        let n = 2 * P::LINKS;
        self.memory.advance(n, accepted, self.options.compensated);
    }
}

impl<P: Rescale<R::Lane>, R: Register> Lanes<'_, P, R> {
    /// Judges the step of a lane: whether it is accepted. Chooses the next one.
    #[inline(always)]
    fn judge_lane(&mut self, runs: &mut Runs<R::Lane>, lane: usize) -> bool {
        let span = runs.span(lane);
        let length = span.step.abs();
        runs.next_step[lane] = runs.step[lane];
        runs.evaluations[lane] += STAGES as u64 - 1;
        if !self.finite_stages[lane].is_finite() {
            let place = self.failed_stage(lane, span, STAGES);
            runs.non_finite(lane, place, self.state(lane, span.time));
            return false;
        }
        let control = &mut self.controls[lane];
        let error = if self.finite_end[lane].is_finite() {
            self.errors[lane]
        } else {
            R::Lane::NAN
        };
        // An error that is NaN must not pass either.
        if !matches!(error.partial_cmp(&R::Lane::ONE), Some(order) if order.is_le()) {
            runs.rejected[lane] += 1;
            runs.step[lane] = length * control.reject(error);
            runs.next_step[lane] = runs.step[lane];
            return false;
        }
        runs.evaluations[lane] += 1;
        if !self.finite_end_rates[lane].is_finite() {
            let place = (runs.end_time[lane], numbers_in(&self.memory.end, lane));
            runs.non_finite(lane, place, self.state(lane, span.time));
            return false;
        }
        let proposed = length * control.accept(error);
        // A step cut short by the end says nothing against the planned one.
        let wanted = if runs.last[lane] {
            proposed.max(runs.step[lane])
        } else {
            proposed
        };
        runs.step[lane] = limit(self.options, wanted);
        runs.next_step[lane] = runs.step[lane];
        true
    }

    /// The state at the start of the step in a lane.
    fn state(&self, lane: usize, time: R::Lane) -> State<R::Lane> {
        State {
            time,
            values: numbers_in(&self.memory.start, lane),
        }
    }

    /// Time and state of the first stage whose rates are not finite in a lane,
    /// at the latest `last`.
    fn failed_stage(
        &self,
        lane: usize,
        span: Span<R::Lane>,
        last: usize,
    ) -> (R::Lane, Vec<R::Lane>) {
        let (memory, n) = (&self.memory, 2 * P::LINKS);
        let failed = |stage: &usize| !numbers(memory.checks[stage - 1])[lane].is_finite();
        let stage = (2..last).find(failed).unwrap_or(last);
        // The same operations as in the step.
        let span = Span {
            time: R::splat(span.time),
            step: R::splat(span.step),
        };
        let values: Vec<R> = (0..n)
            .map(|i| {
                span.step
                    .mul_add(sum(row(stage), &memory.rates, n, i), memory.start[i])
            })
            .collect();
        let time = numbers(node(span, C[stage - 1]))[lane];
        (time, numbers_in(&values, lane))
    }
}

fn limit<T: Real>(options: &Options<T>, step: T) -> T {
    options.max_step.map_or(step, |longest| step.min(longest))
}
