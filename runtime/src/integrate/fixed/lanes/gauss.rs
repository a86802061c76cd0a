//! Gauss–Legendre methods for many trajectories, one in each lane of a vector register. The
//! iteration continues until all lanes are solved; lanes solved earlier keep their result.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;

use super::LaneGrids;
use crate::integrate::error::InputError;
use crate::integrate::evaluator::NonFinite;
use crate::integrate::fixed::Gauss;
use crate::integrate::fixed::gauss::GaussStep;
use crate::integrate::lanes::{Flags, LaneMethod, LaneSteps, LaneSystems, Models, Runs};
use crate::integrate::registers::{Numbers, WIDEST, check_finite, numbers, numbers_in, register};
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::integrate::steps::Failure;
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::{CastOde, State};

impl<O: CastOde<T>, T: Lane> LaneMethod<O, T> for Gauss<T> {
    type Steps<R: Simd<T>> = GaussInLanes<O, T, R>;

    fn check(&self, _dimension: usize) -> Result<(), InputError<T>> {
        self.grid().check()
    }

    fn steps<R: Simd<T>>(&self, system: &O) -> GaussInLanes<O, T, R> {
        let start = vec![R::from_f64(0.0); system.dimension()];
        GaussInLanes {
            systems: LaneSystems::splat(system),
            step: GaussStep::new(self, start),
            grids: LaneGrids::new(self.grid()),
            sought: [false; WIDEST],
        }
    }
}

/// Data of [`Gauss`] during a run with one trajectory in each lane.
pub struct GaussInLanes<O: CastOde<T>, T: Lane, R: Simd<T>> {
    systems: LaneSystems<O, T, R>,
    step: GaussStep<T, R>,
    grids: LaneGrids<T>,
    /// Lanes in which a step is to be solved.
    sought: Flags,
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> LaneSteps<T, R> for GaussInLanes<O, T, R> {
    type System = O;

    fn models(&mut self) -> &mut Models<O, T, R> {
        &mut self.systems.models
    }

    fn set(&mut self, lane: usize, values: Option<&[T]>) {
        self.step.set_lane(lane, values);
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
        if !fresh.contains(&true) {
            return;
        }
        let finite = self.evaluate_start(runs);
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

    #[inline(always)]
    fn plan(&mut self, runs: &mut Runs<T>) -> Flags {
        let stuck = self.grids.plan(runs, R::LANES);
        for lane in 0..R::LANES {
            self.sought[lane] = runs.active[lane] & !stuck[lane];
        }
        stuck
    }

    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>> {
        self.grids.why_stuck(runs, lane)
    }

    #[inline(always)]
    fn attempt(&mut self, span: StepSpan<R>, _size: R) {
        let sought = self.sought;
        self.step
            .make_step(&mut self.systems, span, &sought[..R::LANES]);
    }

    #[inline(always)]
    fn judge(&mut self, runs: &mut Runs<T>) -> Flags {
        let mut accepted = [false; WIDEST];
        let finite_end = numbers(check_finite(R::from_f64(0.0), &self.step.end));
        let mut failed = false;
        for lane in 0..R::LANES {
            if runs.active[lane] {
                runs.evaluations[lane] += self.step.evaluations(lane);
                accepted[lane] = self.step.is_solved(lane) & finite_end[lane].is_finite();
                failed |= !accepted[lane];
            }
            if accepted[lane] {
                self.grids.reach(lane);
            }
        }
        runs.count(R::LANES, &accepted);
        if failed {
            self.halve_or_fail(runs, &accepted);
        }
        accepted
    }

    fn prepare_dense(&mut self, _span: StepSpan<R>) {}

    fn judge_dense(&self, _runs: &mut Runs<T>, _lane: usize) -> Result<(), (T, Vec<T>)> {
        Ok(())
    }

    #[inline(always)]
    fn value(&self, fraction: R, out: &mut [R]) {
        self.step.value(fraction, out);
    }

    #[inline(always)]
    fn advance(&mut self, accepted: R::Mask) {
        let step = &mut self.step;
        for i in 0..self.systems.dimension() {
            step.start[i] = step.end[i].choose(step.start[i], accepted);
            step.residue[i] = step.end_residue[i].choose(step.residue[i], accepted);
        }
    }
}

impl<O: CastOde<T>, T: Lane, R: Simd<T>> GaussInLanes<O, T, R> {
    /// Evaluates the rates at the starts of the steps. Returns, for each lane, a finite number if
    /// all rates are finite.
    #[inline(always)]
    fn evaluate_start(&mut self, runs: &Runs<T>) -> Numbers<T> {
        self.step
            .evaluate_start(&mut self.systems, register(&runs.time));
        numbers(check_finite(R::from_f64(0.0), &self.step.other))
    }

    /// Returns the last accepted state of a lane.
    fn last(&self, runs: &Runs<T>, lane: usize) -> State<T> {
        State {
            time: runs.time[lane],
            values: numbers_in(&self.step.start, lane),
        }
    }

    /// Halves the steps of the lanes that were not solved, or ends their trajectories.
    #[inline(always)]
    fn halve_or_fail(&mut self, runs: &mut Runs<T>, accepted: &Flags) {
        // The rates of a failed step are useless for the next guess.
        let finite_start = self.evaluate_start(runs);
        for lane in 0..R::LANES {
            if !runs.active[lane] || accepted[lane] {
                continue;
            }
            let last = self.last(runs, lane);
            let failure = match self.step.take_failure(lane) {
                Some(failure) => {
                    runs.evaluations[lane] += 1;
                    let finite = finite_start[lane].is_finite();
                    let start = || NonFinite::new(last.time, &last.values).into();
                    if finite { failure } else { start() }
                }
                None => {
                    let span = runs.span(lane);
                    let end = numbers_in(&self.step.end, lane);
                    NonFinite::new(span.time + span.step, &end).into()
                }
            };
            if self.grids.halve(lane) {
                runs.rejected[lane] += 1;
            } else {
                runs.fail(lane, failure, last);
            }
        }
    }
}
