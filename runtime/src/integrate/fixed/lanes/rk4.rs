//! The classical Runge–Kutta method for many trajectories, one in each lane of a vector register.

// One index runs through the arrays of all lanes.
#![allow(clippy::needless_range_loop)]
// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;

use super::LaneGrids;
use crate::integrate::error::InputError;
use crate::integrate::fixed::{Rk4, Rk4Step};
use crate::integrate::lanes::{
    Flags, LaneMethod, LaneSteps, LaneSystems, Models, Runs, StageOfLane,
};
use crate::integrate::piece::hermite;
use crate::integrate::registers::{
    Numbers, WIDEST, check_finite, numbers, numbers_in, register, set_lane,
};
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::integrate::steps::Failure;
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::{CastOde, State};

impl<O: CastOde<T>, T: Lane> LaneMethod<O, T> for Rk4<T> {
    type Steps<R: Simd<T>> = Rk4InLanes<O, T, R>;

    fn check(&self, _dimension: usize) -> Result<(), InputError<T>> {
        self.grid().check()
    }

    fn steps<R: Simd<T>>(&self, system: &O) -> Rk4InLanes<O, T, R> {
        Rk4InLanes {
            systems: LaneSystems::splat(system),
            step: Rk4Step::new(vec![R::from_f64(0.0); system.dimension()]),
            grids: LaneGrids::new(self.grid()),
            finite_end: [T::ZERO; WIDEST],
        }
    }
}

/// Data of [`Rk4`] during a run with one trajectory in each lane.
pub struct Rk4InLanes<O: CastOde<T>, T: Lane, R: Simd<T>> {
    systems: LaneSystems<O, T, R>,
    step: Rk4Step<R>,
    grids: LaneGrids<T>,
    /// For each lane: zero if the state at the end of the step is finite, NaN otherwise.
    finite_end: Numbers<T>,
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> LaneSteps<T, R> for Rk4InLanes<O, T, R> {
    type System = O;

    fn models(&mut self) -> &mut Models<O, T, R> {
        &mut self.systems.models
    }

    fn set(&mut self, lane: usize, values: Option<&[T]>) {
        for i in 0..self.step.start.len() {
            let value = values.map_or(T::ZERO, |values| values[i]);
            set_lane(&mut self.step.start[i], lane, value);
            set_lane(&mut self.step.start_rates[i], lane, T::ZERO);
        }
        self.grids.leave(lane);
    }

    fn start(&self) -> &[R] {
        &self.step.start
    }

    fn end(&self) -> &[R] {
        &self.step.end
    }

    #[inline(always)]
    fn prepare(&mut self, runs: &mut Runs<T>, fresh: &Flags) {
        if fresh.contains(&true) {
            self.begin(runs, fresh);
        }
    }

    #[inline(always)]
    fn plan(&mut self, runs: &mut Runs<T>) -> Flags {
        self.grids.plan(runs, R::LANES)
    }

    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>> {
        self.grids.why_stuck(runs, lane)
    }

    #[inline(always)]
    fn attempt(&mut self, span: StepSpan<R>, _size: R) {
        let Ok(()) = self.step.make_end(&mut self.systems, span);
        let end = &self.step.end[..self.systems.dimension()];
        self.finite_end = numbers(check_finite(R::from_f64(0.0), end));
        let end_time = span.time + span.step;
        let Ok(()) = self.step.evaluate_end(&mut self.systems, end_time);
    }

    #[inline(always)]
    fn judge(&mut self, runs: &mut Runs<T>) -> Flags {
        let mut accepted = [false; WIDEST];
        let stages = Rk4Step::<R>::STAGES;
        let [at_stages, at_end] = [stages, stages + 1].map(|stage| self.systems.check(stage));
        let active = runs.active;
        for lane in (0..R::LANES).filter(|&lane| active[lane]) {
            let finite = [at_stages, self.finite_end, at_end].map(|check| check[lane].is_finite());
            if finite == [true; 3] {
                runs.evaluations[lane] += stages as u64;
                self.grids.reach(lane);
                accepted[lane] = true;
            } else {
                self.fail(runs, lane, finite);
            }
        }
        runs.count(R::LANES, &accepted);
        accepted
    }

    fn prepare_dense(&mut self, _span: StepSpan<R>) {}

    fn judge_dense(&self, _runs: &mut Runs<T>, _lane: usize) -> Result<(), (T, Vec<T>)> {
        Ok(())
    }

    #[inline(always)]
    fn value(&self, fraction: R, out: &mut [R]) {
        let step = &self.step;
        for i in 0..self.systems.dimension() {
            let ends = [step.start[i], step.end[i]];
            let rates = [step.start_rates[i], step.end_rates[i]];
            out[i] = hermite(fraction, step.length, ends, rates);
        }
    }

    #[inline(always)]
    fn advance(&mut self, accepted: R::Mask) {
        let step = &mut self.step;
        for i in 0..self.systems.dimension() {
            step.start[i] = step.end[i].choose(step.start[i], accepted);
            step.start_rates[i] = step.end_rates[i].choose(step.start_rates[i], accepted);
        }
    }
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> Rk4InLanes<O, T, R> {
    /// Evaluates the rates at the start of new trajectories. The other lanes are evaluated too, but
    /// keep their values.
    fn begin(&mut self, runs: &mut Runs<T>, fresh: &Flags) {
        let others = self.step.start_rates.clone();
        let Ok(()) = self
            .step
            .evaluate_start(&mut self.systems, register(&runs.time));
        let mask = R::mask(|lane| fresh[lane]);
        for (rate, other) in self.step.start_rates.iter_mut().zip(others) {
            *rate = rate.choose(other, mask);
        }
        let finite = self.systems.check(1);
        for lane in (0..R::LANES).filter(|&lane| fresh[lane]) {
            let begun = self.grids.begin(runs, lane);
            if begun.is_ok() && finite[lane].is_finite() {
                continue;
            }
            let start = self.last(runs, lane);
            match begun {
                Ok(()) => runs.non_finite(lane, (start.time, start.values.clone()), start),
                Err(failure) => runs.fail(lane, failure, start),
            }
        }
    }

    /// Returns the last accepted state of a lane.
    fn last(&self, runs: &Runs<T>, lane: usize) -> State<T> {
        State {
            time: runs.time[lane],
            values: numbers_in(&self.step.start, lane),
        }
    }

    /// Ends the trajectory in a lane if its stages, the state at the end of the step, or the rates
    /// there are not finite.
    #[cold]
    fn fail(&mut self, runs: &mut Runs<T>, lane: usize, [stages, end, _]: [bool; 3]) {
        let last = self.last(runs, lane);
        let span = runs.span(lane);
        let place = if stages {
            let evaluations = Rk4Step::<R>::STAGES as u64 - u64::from(!end);
            runs.evaluations[lane] += evaluations;
            (span.time + span.step, numbers_in(&self.step.end, lane))
        } else {
            let stage = self.systems.failed_stage(lane, 2, Rk4Step::<R>::STAGES);
            runs.evaluations[lane] += stage as u64 - 1;
            self.stage_input(runs, lane, stage)
        };
        runs.non_finite(lane, place, last);
    }

    /// Returns the time and the state of a stage in a lane. Computes them by repeating the step,
    /// with the same bits.
    fn stage_input(&mut self, runs: &Runs<T>, lane: usize, stage: usize) -> (T, Vec<T>) {
        let span = StepSpan {
            time: register(&runs.time),
            step: register(&runs.length),
        };
        let mut seen = StageOfLane {
            systems: &mut self.systems,
            lane,
            stage,
            place: (T::NAN, Vec::new()),
        };
        let Ok(()) = self.step.make_end(&mut seen, span);
        seen.place
    }
}
