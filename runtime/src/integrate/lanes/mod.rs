//! Integration of many trajectories in the lanes of vector registers.
//!
//! A method computes its steps for all lanes at once. Every lane has a separate time, step, error
//! and control, by the rules of single trajectories. A lane whose step is rejected keeps its state.
//! A lane whose trajectory has ended gets the next start, with the constants of its system. Lanes
//! without a trajectory do not move.

// One index runs through the arrays of all lanes.
#![allow(clippy::needless_range_loop)]

mod cases;
mod endings;
mod method;
mod models;
mod runs;
mod samples;
mod systems;
#[cfg(test)]
pub(in crate::integrate) mod tests;

use alloc::vec::Vec;

pub(crate) use self::cases::Cases;
pub use self::endings::Ending;
use self::endings::{LaneEndings, events};
pub use self::method::LaneMethod;
pub(crate) use self::method::LaneSteps;
pub(crate) use self::models::Models;
pub(crate) use self::runs::{Flags, Outcome, Runs};
use self::samples::LaneSamples;
pub(crate) use self::systems::{LaneSystems, StageOfLane};
use super::error::InputError;
use super::registers::{self, Numbers, WIDEST, register};
use super::request::{check_end, check_start, check_times};
use super::right_hand_side::StepSpan;
use crate::interruption;
use crate::scalar::{InstructionSet, Lane};
use crate::simd::{Kernel, Simd, dispatch};
use crate::system::{CastOde, State};

/// List of trajectories to integrate in lanes, with the method, the output times and the end.
pub(crate) struct Task<'a, M, O, T> {
    pub(crate) instructions: InstructionSet,
    pub(crate) method: &'a M,
    pub(crate) cases: Cases<'a, O, T>,
    /// Output times of all trajectories that have no separate ones.
    pub(crate) times: &'a [T],
    /// End time of all trajectories; `None` ends each trajectory at its start.
    pub(crate) end: Option<T>,
    /// Conditions that end a trajectory before its end time.
    pub(crate) endings: &'a [Ending<'a, T>],
}

impl<M, O, T: Lane> Task<'_, M, O, T> {
    /// Returns the output times of trajectory number `index`.
    fn times(&self, index: usize) -> &[T] {
        self.cases.times(index).unwrap_or(self.times)
    }

    /// Returns the end time of trajectory number `index`; `None` ends it at its start.
    fn end(&self, index: usize) -> Option<T> {
        match self.cases.times(index) {
            Some(times) => times.last().copied(),
            None => self.end,
        }
    }
}

/// Integrates the trajectories whose indices `next` returns, until it returns `None`, and passes
/// each outcome with its index to `done`.
///
/// Registers are allocated once. A trajectory allocates when it starts and when it ends; steps
/// allocate nothing.
pub(crate) fn integrate<M, O, T>(
    task: &Task<'_, M, O, T>,
    next: &mut dyn FnMut() -> Option<usize>,
    done: &mut dyn FnMut(usize, Outcome<T>),
) where
    M: LaneMethod<O, T>,
    O: CastOde<T>,
    T: Lane,
{
    let kernel = LaneDriver { task, next, done };
    dispatch::run_in_registers(task.instructions, kernel);
}

/// Integration loop, compiled once per method and system: `next` and `done` are called through
/// pointers, once per trajectory.
struct LaneDriver<'a, M, O, T> {
    task: &'a Task<'a, M, O, T>,
    next: &'a mut dyn FnMut() -> Option<usize>,
    done: &'a mut dyn FnMut(usize, Outcome<T>),
}

impl<M, O, T> Kernel<T> for LaneDriver<'_, M, O, T>
where
    M: LaneMethod<O, T>,
    O: CastOde<T>,
    T: Lane,
{
    type Output = ();

    #[inline(always)]
    fn run<R: Simd<T>>(mut self) {
        // The list is empty.
        let Some((first, _)) = self.task.cases.get(0) else {
            return;
        };
        let method = self.task.method;
        let dimension = first.dimension();
        if let Err(error) = method.check(dimension) {
            self.refuse_all(&error);
            return;
        }
        let mut steps = method.steps::<R>(first);
        let mut runs = Runs::new();
        let is_sampled = !self.task.times.is_empty() || matches!(self.task.cases, Cases::Timed(..));
        let mut samples = LaneSamples::new(dimension);
        let events = events(self.task.endings);
        let mut endings = LaneEndings::new(&events, dimension);
        let mut fresh = self.fill(&mut steps, &mut runs);
        while runs.active.contains(&true) {
            interruption::look();
            if !events.is_empty() {
                endings.begin(&steps, &fresh);
            }
            steps.prepare(&mut runs, &fresh);
            self.report_failed(&mut steps, &mut runs);
            let (span, size) = self.plan(&mut steps, &mut runs);
            steps.attempt(span, size);
            let accepted = steps.judge(&mut runs);
            if is_sampled {
                let times = |index| self.task.times(index);
                samples.take(&mut steps, &mut runs, times, &accepted, span);
            }
            if !events.is_empty() {
                endings.take(&mut steps, &mut runs, &accepted, span);
            }
            let ended = runs.advance(R::LANES, &accepted);
            steps.advance(R::mask(|lane| accepted[lane]));
            if ended {
                self.finish(&mut steps, &mut runs);
            }
            self.report_failed(&mut steps, &mut runs);
            fresh = [false; WIDEST];
            if runs.active[..R::LANES].contains(&false) {
                fresh = self.fill(&mut steps, &mut runs);
            }
        }
    }
}

impl<M, O, T> LaneDriver<'_, M, O, T>
where
    M: LaneMethod<O, T>,
    O: CastOde<T>,
    T: Lane,
{
    fn refuse_all(&mut self, error: &InputError<T>) {
        while let Some(index) = (self.next)() {
            // An error of the start is reported first, as for single trajectories.
            let case = self.task.cases.get(index);
            let error = match case.map(|(system, start)| self.check(index, system, start)) {
                Some(Err(error)) => error,
                _ => error.clone(),
            };
            (self.done)(index, Outcome::refused(error));
        }
    }

    fn check(&self, index: usize, system: &O, start: &State<T>) -> Result<(), InputError<T>> {
        check_start(system, (start.time, &start.values))?;
        check_times(start.time, self.task.times(index))?;
        self.task.end(index).map_or(Ok(()), check_end)?;
        self.task.method.check_start(&start.values)
    }

    /// Assigns a trajectory to every free lane, as long as any remain. Returns the lanes that
    /// received one.
    fn fill<R: Simd<T>>(
        &mut self,
        steps: &mut impl LaneSteps<T, R, System = O>,
        runs: &mut Runs<T>,
    ) -> Flags {
        let mut fresh = [false; WIDEST];
        for lane in 0..R::LANES {
            while !runs.active[lane]
                && let Some(index) = (self.next)()
                && let Some((system, start)) = self.task.cases.get(index)
            {
                let mut checked = self.check(index, system, start);
                if checked.is_ok() && self.task.cases.models_differ() {
                    checked = steps.models().set(lane, system);
                }
                if let Err(error) = checked {
                    (self.done)(index, Outcome::refused(error));
                    continue;
                }
                let end = self.task.end(index).unwrap_or(start.time);
                runs.begin(lane, index, start.time, end);
                runs.sample_start(lane, self.task.times(index), &start.values);
                if start.time == end {
                    let (index, outcome) = runs.finish(lane, start.values.clone());
                    (self.done)(index, outcome);
                } else {
                    steps.set(lane, Some(&start.values));
                    fresh[lane] = true;
                }
            }
        }
        fresh
    }

    /// Returns the time and step of every lane, and the absolute step lengths. Trajectories that
    /// cannot continue are removed from their lanes.
    #[inline(always)]
    fn plan<R: Simd<T>>(
        &mut self,
        steps: &mut impl LaneSteps<T, R, System = O>,
        runs: &mut Runs<T>,
    ) -> (StepSpan<R>, R) {
        let stuck = steps.plan(runs);
        if stuck.contains(&true) {
            for lane in (0..R::LANES).filter(|&lane| stuck[lane]) {
                let last = State {
                    time: runs.time[lane],
                    values: registers::numbers_in(steps.start(), lane),
                };
                if let Some(failure) = steps.why_stuck(runs, lane) {
                    runs.fail(lane, failure, last);
                }
            }
            self.report_failed(steps, runs);
        }
        let (mut step, mut size): (Numbers<T>, Numbers<T>) = (runs.time, runs.time);
        for lane in 0..R::LANES {
            step[lane] = runs.span(lane).step;
            size[lane] = step[lane].abs();
        }
        let span = StepSpan {
            time: register(&runs.time),
            step: register(&step),
        };
        (span, register(&size))
    }

    /// Passes the outcomes of trajectories that failed or were stopped to `done`.
    #[inline(always)]
    fn report_failed<R: Simd<T>>(
        &mut self,
        steps: &mut impl LaneSteps<T, R, System = O>,
        runs: &mut Runs<T>,
    ) {
        while let Some((lane, index, outcome)) = runs.take_failed() {
            (self.done)(index, outcome);
            steps.set(lane, None);
            self.replace_model(steps, runs, lane);
        }
    }

    /// Replaces the system of a lane whose trajectory has failed by the system of another lane. A
    /// system that failed in motion might also fail at rest, which would slow down the other lanes.
    #[cold]
    fn replace_model<R: Simd<T>>(
        &self,
        steps: &mut impl LaneSteps<T, R, System = O>,
        runs: &Runs<T>,
        lane: usize,
    ) {
        if self.task.cases.models_differ()
            && let Some(index) = runs.any()
            && let Some((system, _)) = self.task.cases.get(index)
        {
            // The system is in another lane already, so its constants fit.
            let _ = steps.models().set(lane, system);
        }
    }

    /// Passes the outcomes of trajectories that have reached their end to `done`.
    fn finish<R: Simd<T>>(&mut self, steps: &mut impl LaneSteps<T, R>, runs: &mut Runs<T>) {
        for lane in 0..R::LANES {
            if runs.active[lane] && runs.time[lane] == runs.end[lane] {
                let values = registers::numbers_in(steps.start(), lane);
                let (index, outcome) = runs.finish(lane, values);
                (self.done)(index, outcome);
                steps.set(lane, None);
            }
        }
    }
}

impl<T> Outcome<T> {
    fn refused(error: InputError<T>) -> Self {
        Self {
            end: Err(error.into()),
            samples: Vec::new(),
        }
    }
}
