//! Explicit Runge–Kutta pairs in the lanes of vector registers.

// A sealed trait names the types.
#![allow(unreachable_pub)]
// One index into all components at once.
#![allow(clippy::needless_range_loop)]

mod first;
mod memory;
mod pair;
mod step;

use alloc::vec::Vec;
use core::marker::PhantomData;

pub(super) use self::memory::{Memory, sum};
pub(super) use self::pair::LanePair;
pub(super) use self::step::make_stages;
use self::step::node;
use super::ExplicitRungeKutta;
use super::arithmetic::Span;
use crate::integrate::control::StepControl;
use crate::integrate::lanes::registers::{Numbers, WIDEST, numbers, numbers_in};
use crate::integrate::lanes::{Flags, LaneMethod, Models, Runs, Stepper};
use crate::integrate::options::Options;
use crate::scalar::register::Register;
use crate::scalar::{Lane, Real};
use crate::system::{Cast, State};

impl<M: LanePair, P: Cast<T>, T: Lane> LaneMethod<P, T> for ExplicitRungeKutta<M, T> {
    type Stepper<'a, R: Register<Lane = T>> = Lanes<'a, M, P, R>;

    fn options(&self) -> &Options<T> {
        &self.options
    }

    fn stepper<'a, R: Register<Lane = T>>(&'a self, pendulum: &P) -> Lanes<'a, M, P, R> {
        let zero = [T::ZERO; WIDEST];
        let control = StepControl::new(M::CONTROL, self.options.beta);
        Lanes {
            models: Models::splat(pendulum),
            options: &self.options,
            memory: Memory::new::<M>(&self.options, 2 * P::LINKS),
            controls: core::array::from_fn(|_| control.clone()),
            errors: zero,
            finite_stages: zero,
            finite_end: zero,
            finite_end_rates: zero,
            pair: PhantomData,
        }
    }
}

/// The method at work.
pub struct Lanes<'a, M, P: Cast<R::Lane>, R: Register> {
    models: Models<P, R>,
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
    pair: PhantomData<M>,
}

impl<M: LanePair, P: Cast<R::Lane>, R: Register> Stepper<R> for Lanes<'_, M, P, R> {
    type Pendulum = P;

    fn models(&mut self) -> &mut Models<P, R> {
        &mut self.models
    }

    fn set(&mut self, lane: usize, values: Option<&[R::Lane]>) {
        self.memory.set(lane, values);
        self.controls[lane] = StepControl::new(M::CONTROL, self.options.beta);
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
        self.finite_end =
            numbers(memory.step::<M, P>(&self.models, span, self.options.compensated));
        self.errors = numbers(M::errors(memory, 2 * P::LINKS, size));
        self.finite_stages = numbers(memory.checks[M::STAGES - 1]);
        self.finite_end_rates = numbers(memory.checks[M::STAGES]);
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
        M::prepare_dense_in_lanes(&mut self.memory, &self.models, span);
    }

    fn judge_dense(
        &self,
        runs: &mut Runs<R::Lane>,
        lane: usize,
    ) -> Result<(), (R::Lane, Vec<R::Lane>)> {
        if numbers(self.memory.checks[M::STAGES_DENSE - 1])[lane].is_finite() {
            runs.evaluations[lane] += (M::STAGES_DENSE - M::STAGES - 1) as u64;
            return Ok(());
        }
        Err(self.failed_stage(lane, runs.span(lane), M::STAGES_DENSE))
    }

    #[inline(always)]
    fn value(&self, fraction: R, out: &mut [R]) {
        M::dense_outputs(&self.memory, fraction, out);
    }

    #[inline(always)]
    fn advance(&mut self, accepted: R::Mask) {
        let n = 2 * P::LINKS;
        self.memory
            .advance::<M>(n, accepted, self.options.compensated);
    }
}

impl<M: LanePair, P: Cast<R::Lane>, R: Register> Lanes<'_, M, P, R> {
    /// Judges the step of a lane: whether it is accepted. Chooses the next one.
    #[inline(always)]
    fn judge_lane(&mut self, runs: &mut Runs<R::Lane>, lane: usize) -> bool {
        let span = runs.span(lane);
        let length = span.step.abs();
        runs.next_step[lane] = runs.step[lane];
        runs.evaluations[lane] += M::STAGES as u64 - 1;
        if !self.finite_stages[lane].is_finite() {
            let place = self.failed_stage(lane, span, M::STAGES);
            runs.non_finite(lane, place, self.state(lane, span.time));
            return false;
        }
        let finite = self.finite_end[lane].is_finite();
        if M::ERROR_USES_END && finite && !self.judge_end(runs, lane) {
            return false;
        }
        let error = if finite {
            self.errors[lane]
        } else {
            R::Lane::NAN
        };
        // An error that is NaN must not pass either.
        if !matches!(error.partial_cmp(&R::Lane::ONE), Some(order) if order.is_le()) {
            runs.rejected[lane] += 1;
            runs.step[lane] = length * self.controls[lane].reject(error);
            runs.next_step[lane] = runs.step[lane];
            return false;
        }
        if !M::ERROR_USES_END && !self.judge_end(runs, lane) {
            return false;
        }
        let proposed = length * self.controls[lane].accept(error);
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

    /// Counts the rates at the end of a lane's step: whether they are finite. Ends
    /// the trajectory if not.
    #[inline(always)]
    fn judge_end(&self, runs: &mut Runs<R::Lane>, lane: usize) -> bool {
        runs.evaluations[lane] += 1;
        let finite = self.finite_end_rates[lane].is_finite();
        if !finite {
            let place = (runs.end_time[lane], numbers_in(&self.memory.end, lane));
            runs.non_finite(lane, place, self.state(lane, runs.time[lane]));
        }
        finite
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
                span.step.mul_add(
                    sum(M::ROWS[stage - 2], &memory.rates, n, i),
                    memory.start[i],
                )
            })
            .collect();
        let time = numbers(node(span, M::NODES[stage - 1]))[lane];
        (time, numbers_in(&values, lane))
    }
}

fn limit<T: Real>(options: &Options<T>, step: T) -> T {
    options.max_step.map_or(step, |longest| step.min(longest))
}
