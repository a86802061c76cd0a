//! Explicit Runge–Kutta pairs for many trajectories, one in each lane of a vector register.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;
use core::convert::Infallible;
use core::marker::PhantomData;

use super::ExplicitRungeKutta;
use super::pair::EmbeddedPair;
use super::smallest_tolerance;
use super::stages::{ErrorScale, StepStages, sum, terms};
use crate::integrate::control::{FirstStep, StepControl, Verdict};
use crate::integrate::error::InputError;
use crate::integrate::lanes::{Flags, LaneMethod, LaneSteps, LaneSystems, Models, Runs};
use crate::integrate::registers::{
    Numbers, WIDEST, check_finite, numbers, numbers_in, register, set_lane, smallest_divisor,
};
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::integrate::steps::{Failure, StepLimits};
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::{CastOde, State};

impl<M: EmbeddedPair, O: CastOde<T>, T: Lane> LaneMethod<O, T> for ExplicitRungeKutta<M, T> {
    type Steps<R: Simd<T>> = PairInLanes<M, O, T, R>;

    fn check(&self, dimension: usize) -> Result<(), InputError<T>> {
        self.options.validate(dimension)
    }

    fn check_start(&self, values: &[T]) -> Result<(), InputError<T>> {
        self.options.check_digits(values, smallest_tolerance())
    }

    fn steps<R: Simd<T>>(&self, system: &O) -> PairInLanes<M, O, T, R> {
        let start = vec![R::from_f64(0.0); system.dimension()];
        let control = StepControl::new(M::CONTROL, &self.options);
        PairInLanes {
            system: Systems {
                lanes: LaneSystems::splat(system),
                smallest: R::splat(smallest_divisor()),
            },
            limits: StepLimits::new(&self.options),
            stages: StepStages::new::<M, T>(&self.options, start, R::splat),
            controls: core::array::from_fn(|_| control.clone()),
            errors: [T::ZERO; WIDEST],
            finite_end: [T::ZERO; WIDEST],
            pair: PhantomData,
        }
    }
}

/// The systems of all lanes, with the smallest divisor that scaled errors need.
struct Systems<O: CastOde<T>, T: Lane, R: Simd<T>> {
    lanes: LaneSystems<O, T, R>,
    /// Smallest positive divisor; it avoids 0/0 for components that are exactly zero.
    smallest: R,
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> RightHandSide<R> for Systems<O, T, R> {
    type Failure = Infallible;

    #[inline(always)]
    fn dimension(&self) -> usize {
        self.lanes.dimension()
    }

    #[inline(always)]
    fn write(&mut self, time: R, state: &[R], rates: &mut [R]) {
        self.lanes.write(time, state, rates);
    }

    #[inline(always)]
    fn evaluate(
        &mut self,
        stage: usize,
        time: R,
        state: &[R],
        rates: &mut [R],
    ) -> Result<(), Infallible> {
        self.lanes.evaluate(stage, time, state, rates)
    }
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> ErrorScale<R> for Systems<O, T, R> {
    type Accepted = R::Mask;

    #[inline(always)]
    fn larger_size(one: R, other: R) -> R {
        one.larger_size(other)
    }

    #[inline(always)]
    fn scaled<const N: usize>(&self, mut values: [R; N], tolerance: R) -> [R; N] {
        let inverse = R::from_f64(1.0) / tolerance.larger_size(self.smallest);
        for value in &mut values {
            *value = *value * inverse;
        }
        values
    }

    #[inline(always)]
    fn accept(new: R, old: R, accepted: R::Mask) -> R {
        new.choose(old, accepted)
    }
}

/// Data of an explicit pair during a run with one trajectory in each lane.
pub struct PairInLanes<M, O: CastOde<T>, T: Lane, R: Simd<T>> {
    system: Systems<O, T, R>,
    limits: StepLimits<T>,
    stages: StepStages<R>,
    controls: [StepControl<T>; WIDEST],
    /// Scaled error of the step, for each lane.
    errors: Numbers<T>,
    /// For each lane: zero if the state at the end of the step is finite, NaN otherwise.
    finite_end: Numbers<T>,
    pair: PhantomData<M>,
}

impl<M: EmbeddedPair, O: CastOde<T>, T: Lane, R: Simd<T>> LaneSteps<T, R>
    for PairInLanes<M, O, T, R>
{
    type System = O;

    fn models(&mut self) -> &mut Models<O, T, R> {
        &mut self.system.lanes.models
    }

    fn set(&mut self, lane: usize, values: Option<&[T]>) {
        let stages = &mut self.stages;
        for i in 0..stages.start.len() {
            let value = values.map_or(T::ZERO, |values| values[i]);
            set_lane(&mut stages.start[i], lane, value);
            set_lane(&mut stages.start_residue[i], lane, T::ZERO);
            set_lane(&mut stages.rates[i], lane, T::ZERO);
        }
        self.controls[lane].forget();
    }

    fn start(&self) -> &[R] {
        &self.stages.start
    }

    fn end(&self) -> &[R] {
        &self.stages.end
    }

    #[inline(always)]
    fn prepare(&mut self, runs: &mut Runs<T>, fresh: &Flags) {
        if fresh.contains(&true) {
            self.first_steps(runs, fresh);
        }
    }

    #[inline(always)]
    fn plan(&mut self, runs: &mut Runs<T>) -> Flags {
        runs.plan(R::LANES, &self.limits)
    }

    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>> {
        runs.why_stuck(lane, &self.limits)
    }

    #[inline(always)]
    fn attempt(&mut self, span: StepSpan<R>, size: R) {
        let (system, stages) = (&mut self.system, &mut self.stages);
        let Ok(()) = stages.make::<M, _>(system, span);
        let end = &stages.end[..system.dimension()];
        self.finite_end = numbers(check_finite(R::from_f64(0.0), end));
        let Ok(()) = stages.evaluate_end::<M, _>(system, span.time + span.step);
        self.errors = numbers(M::error(stages, system, size));
    }

    #[inline(always)]
    fn judge(&mut self, runs: &mut Runs<T>) -> Flags {
        let mut accepted = [false; WIDEST];
        let checks = [M::STAGES, M::STAGES + 1].map(|stage| self.system.lanes.check(stage));
        for (lane, accepted) in accepted.iter_mut().enumerate().take(R::LANES) {
            if runs.active[lane] {
                *accepted = self.judge_lane(runs, lane, checks.map(|check| check[lane]));
            }
        }
        runs.count(R::LANES, &accepted);
        accepted
    }

    #[inline(always)]
    fn prepare_dense(&mut self, span: StepSpan<R>) {
        let Ok(()) = self.stages.prepare_dense::<M, _>(&mut self.system, span);
    }

    fn judge_dense(&self, runs: &mut Runs<T>, lane: usize) -> Result<(), (T, Vec<T>)> {
        let stages = M::NODES.len();
        if self.system.lanes.check(stages)[lane].is_finite() {
            runs.evaluations[lane] += (stages - M::STAGES - 1) as u64;
            return Ok(());
        }
        let failed = self.system.lanes.failed_stage(lane, M::STAGES + 2, stages);
        Err(self.stage_input(lane, runs.span(lane), failed))
    }

    #[inline(always)]
    fn value(&self, fraction: R, out: &mut [R]) {
        self.stages.value::<M>(fraction, out);
    }

    #[inline(always)]
    fn advance(&mut self, accepted: R::Mask) {
        self.stages
            .advance::<M, Systems<O, T, R>>(self.system.dimension(), accepted);
    }
}

impl<M: EmbeddedPair, O: CastOde<T>, T: Lane, R: Simd<T>> PairInLanes<M, O, T, R> {
    /// Accepts or rejects the step of a lane, as the driver of single trajectories does, and
    /// chooses the next step. Returns true if the step is accepted.
    #[inline(always)]
    fn judge_lane(&mut self, runs: &mut Runs<T>, lane: usize, [stages, end_rates]: [T; 2]) -> bool {
        let span = runs.span(lane);
        runs.next_step[lane] = runs.step[lane];
        if !stages.is_finite() {
            let failed = self.system.lanes.failed_stage(lane, 2, M::STAGES);
            runs.evaluations[lane] += failed as u64 - 1;
            self.fail(runs, lane, self.stage_input(lane, span, failed));
            return false;
        }
        runs.evaluations[lane] += M::STAGES as u64 - 1;
        let finite = self.finite_end[lane].is_finite();
        if M::ERROR_USES_END && finite && !self.judge_end(runs, lane, end_rates) {
            return false;
        }
        let error = if finite { self.errors[lane] } else { T::NAN };
        let planned = (runs.step[lane], runs.last[lane]);
        let next = match self.controls[lane].judge(error, span.step.abs(), planned) {
            Verdict::Accepted(next) => next,
            Verdict::Rejected(next) => {
                runs.rejected[lane] += 1;
                (runs.step[lane], runs.next_step[lane]) = (next, next);
                return false;
            }
        };
        if !M::ERROR_USES_END && !self.judge_end(runs, lane, end_rates) {
            return false;
        }
        (runs.step[lane], runs.next_step[lane]) = (next, next);
        true
    }

    /// Counts the evaluation at the end of a lane's step. If the rates there are not finite, ends
    /// the trajectory and returns false.
    #[inline(always)]
    fn judge_end(&self, runs: &mut Runs<T>, lane: usize, check: T) -> bool {
        runs.evaluations[lane] += 1;
        if !check.is_finite() {
            let place = (runs.end_time[lane], numbers_in(&self.stages.end, lane));
            self.fail(runs, lane, place);
        }
        check.is_finite()
    }

    /// Ends the trajectory in a lane because rates or values at `place` (time and state) are not
    /// finite.
    #[cold]
    fn fail(&self, runs: &mut Runs<T>, lane: usize, place: (T, Vec<T>)) {
        let last = State {
            time: runs.time[lane],
            values: numbers_in(&self.stages.start, lane),
        };
        runs.non_finite(lane, place, last);
    }

    /// Returns the time and the state at which a stage of a lane was evaluated.
    #[cold]
    fn stage_input(&self, lane: usize, span: StepSpan<T>, stage: usize) -> (T, Vec<T>) {
        let (stages, n) = (&self.stages, self.system.dimension());
        // The operations are those of the step, so that the bits are equal.
        let span = StepSpan {
            time: R::splat(span.time),
            step: R::splat(span.step),
        };
        let row = M::ROWS[stage - 2];
        let terms = terms(row, &stages.rates, n);
        let value = |i| span.step.mul_add(sum(row, &terms, i), stages.start[i]);
        let values: Vec<R> = (0..n).map(value).collect();
        let time = numbers(span.node(M::NODES[stage - 1]))[lane];
        (time, numbers_in(&values, lane))
    }

    /// Computes the first stage and the first step length of the trajectories that start now. The
    /// other lanes are computed too, but keep their values.
    #[inline(always)]
    fn first_steps(&mut self, runs: &mut Runs<T>, fresh: &Flags) {
        let (system, stages) = (&mut self.system, &mut self.stages);
        let others = stages.start_rates().to_vec();
        let Ok(()) = stages.evaluate_start(system, register(&runs.time));
        let mask = R::mask(|lane| fresh[lane]);
        for (rate, other) in stages.rates.iter_mut().zip(others) {
            *rate = rate.choose(other, mask);
        }
        let finite = system.lanes.check(1);
        let state = numbers(stages.norm(system, &stages.start));
        let rates = numbers(stages.norm(system, stages.start_rates()));
        let limits = self.limits;
        let first = |lane: usize, runs: &Runs<T>| FirstStep {
            state: state[lane],
            rates: rates[lane],
            longest: limits.limit((runs.end[lane] - runs.time[lane]).abs()),
        };
        let fresh = || (0..R::LANES).filter(|&lane| fresh[lane]);
        let mut euler = [T::ZERO; WIDEST];
        for lane in fresh() {
            runs.evaluations[lane] += 1;
            if !finite[lane].is_finite() {
                let values = numbers_in(&self.stages.start, lane);
                self.fail(runs, lane, (runs.time[lane], values));
            } else if let Some(step) = limits.initial {
                runs.step[lane] = limits.limit(step);
            } else {
                runs.evaluations[lane] += 1;
                runs.step[lane] = first(lane, runs).euler();
                euler[lane] = runs.direction[lane] * runs.step[lane];
            }
        }
        let span = StepSpan {
            time: register(&runs.time),
            step: register(&euler),
        };
        let Ok(change) = self.stages.euler_change(&mut self.system, span);
        let (change, finite) = (numbers(change), self.system.lanes.check(2));
        for lane in fresh() {
            if !runs.active[lane] || limits.initial.is_some() {
                continue;
            }
            if finite[lane].is_finite() {
                let first = first(lane, runs);
                runs.step[lane] = first.refined(runs.step[lane], change[lane], M::CONTROL.order);
            } else {
                let values = numbers_in(&self.stages.stage, lane);
                self.fail(runs, lane, (runs.time[lane] + euler[lane], values));
            }
        }
    }
}
