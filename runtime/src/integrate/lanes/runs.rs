//! Trajectories in the lanes of vector registers: their times, steps, reports and samples.

// One index runs through the arrays of all lanes.
#![allow(clippy::needless_range_loop)]
#![allow(unreachable_pub)]

use alloc::vec::Vec;

use crate::integrate::error::IntegrationError;
use crate::integrate::evaluator::NonFinite;
use crate::integrate::registers::{Numbers, WIDEST};
use crate::integrate::report::{Report, Solution, StopReason, extremes};
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::steps::{Failure, Goal, StepLimits, towards};
use crate::scalar::Real;
use crate::system::State;

/// One flag for each lane.
pub(crate) type Flags = [bool; WIDEST];

/// Outcome of a trajectory, with its samples.
#[derive(Clone, Debug)]
pub(crate) struct Outcome<T> {
    /// Last state and report of the trajectory, or its error.
    pub(crate) end: Result<Solution<T>, IntegrationError<T>>,
    /// Trajectories in the lanes, stored as one array per quantity, so that each step consists of
    /// short loops without branches.
    pub(crate) samples: Vec<T>,
}

/// Trajectories in the lanes, as one array for each quantity, so that the work of every step is
/// short loops without branches.
///
/// All numbers of a lane without a trajectory are zero.
#[derive(Debug)]
pub struct Runs<T> {
    /// True for each lane that has a trajectory.
    pub(crate) active: Flags,
    /// Index, in the list of all trajectories, of the trajectory in each lane.
    index: [usize; WIDEST],
    /// Time at the start of the step in each lane.
    pub(crate) time: Numbers<T>,
    /// End time of the trajectory.
    pub(crate) end: Numbers<T>,
    /// Direction of the run: 1 forwards, −1 backwards in time.
    pub(crate) direction: Numbers<T>,
    /// Length of the step to try next in each lane.
    pub(crate) step: Numbers<T>,
    /// End time of the step that is being tried, and its signed length.
    pub(crate) end_time: Numbers<T>,
    pub(crate) length: Numbers<T>,
    /// True if the step being tried reaches the end of the trajectory.
    pub(crate) last: Flags,
    pub(crate) accepted: [u64; WIDEST],
    pub(crate) rejected: [u64; WIDEST],
    pub(crate) evaluations: [u64; WIDEST],
    shortest: Numbers<T>,
    longest: Numbers<T>,
    pub(crate) next_step: Numbers<T>,
    samples: [Vec<T>; WIDEST],
    /// Number of output times whose samples have been taken.
    sampled: [usize; WIDEST],
    /// Trajectories that failed or were stopped and have not been reported yet: lane, index,
    /// outcome.
    failed: Vec<(usize, usize, Outcome<T>)>,
}

impl<T: Real> Runs<T> {
    pub(super) fn new() -> Self {
        let zero = [T::ZERO; WIDEST];
        Self {
            active: [false; WIDEST],
            index: [0; WIDEST],
            time: zero,
            end: zero,
            direction: zero,
            step: zero,
            end_time: zero,
            length: zero,
            last: [false; WIDEST],
            accepted: [0; WIDEST],
            rejected: [0; WIDEST],
            evaluations: [0; WIDEST],
            shortest: zero,
            longest: zero,
            next_step: zero,
            samples: [const { Vec::new() }; WIDEST],
            sampled: [0; WIDEST],
            failed: Vec::new(),
        }
    }

    /// Puts a trajectory into a lane and sets its start time and end time.
    pub(super) fn begin(&mut self, lane: usize, index: usize, time: T, end: T) {
        self.active[lane] = true;
        self.index[lane] = index;
        self.time[lane] = time;
        self.end[lane] = end;
        self.direction[lane] = if end > time { T::ONE } else { -T::ONE };
    }

    /// Returns the index of an arbitrary trajectory that is in a lane; `None` if all lanes are
    /// empty.
    pub(super) fn any(&self) -> Option<usize> {
        let lane = self.active.iter().position(|&active| active)?;
        Some(self.index[lane])
    }

    /// Removes the trajectory from a lane. Returns its index and its samples.
    fn leave(&mut self, lane: usize) -> (usize, Vec<T>) {
        let zero = T::ZERO;
        self.active[lane] = false;
        for numbers in [
            &mut self.time,
            &mut self.end,
            &mut self.direction,
            &mut self.step,
            &mut self.end_time,
            &mut self.length,
            &mut self.shortest,
            &mut self.longest,
            &mut self.next_step,
        ] {
            numbers[lane] = zero;
        }
        self.accepted[lane] = 0;
        self.rejected[lane] = 0;
        self.evaluations[lane] = 0;
        self.sampled[lane] = 0;
        (self.index[lane], core::mem::take(&mut self.samples[lane]))
    }

    /// Plans the steps of all lanes, with the lengths that the control has chosen. Returns the
    /// lanes whose step is not allowed.
    #[inline(always)]
    pub(crate) fn plan(&mut self, lanes: usize, limits: &StepLimits<T>) -> Flags {
        let mut stuck = [false; WIDEST];
        for lane in 0..lanes.min(WIDEST) {
            let (time, step) = (self.time[lane], self.step[lane]);
            let (end_time, last) = towards(self.end[lane], self.direction[lane], time, step);
            self.end_time[lane] = end_time;
            // The length is the difference of the rounded times, so that lengths add up to times.
            self.length[lane] = end_time - time;
            self.last[lane] = last;
            let steps = self.accepted[lane] + self.rejected[lane];
            stuck[lane] = self.active[lane] & !limits.allow(steps, (time, step, last));
        }
        stuck
    }

    /// Returns the reason why the planned step of a lane is not allowed; `None` if it is allowed.
    pub(crate) fn why_stuck(&self, lane: usize, limits: &StepLimits<T>) -> Option<Failure<T>> {
        let attempt = (self.time[lane], self.step[lane], self.last[lane]);
        limits.check(&self.report(lane), 0, attempt).err()
    }

    /// Returns the start time and the length of the step that is being tried in a lane.
    #[inline(always)]
    pub(crate) fn span(&self, lane: usize) -> StepSpan<T> {
        StepSpan {
            time: self.time[lane],
            step: self.length[lane],
        }
    }

    /// Returns the end time and direction of the trajectory in a lane.
    #[inline(always)]
    pub(crate) fn goal(&self, lane: usize) -> Goal<T> {
        Goal {
            end: Some(self.end[lane]),
            direction: self.direction[lane],
            steps_before: 0,
        }
    }

    /// Counts accepted and rejected steps.
    #[inline(always)]
    pub(crate) fn count(&mut self, lanes: usize, accepted: &Flags) {
        for lane in 0..lanes.min(WIDEST) {
            let size = self.span(lane).step.abs();
            let before = [self.shortest[lane], self.longest[lane]];
            let after = extremes(before, self.accepted[lane] == 0, size);
            let accepted = accepted[lane];
            [self.shortest[lane], self.longest[lane]] = if accepted { after } else { before };
            self.accepted[lane] += u64::from(accepted);
        }
    }

    /// Makes the end of each accepted step the start of the next one. Returns true if a trajectory
    /// has reached its end.
    #[inline(always)]
    pub(super) fn advance(&mut self, lanes: usize, accepted: &Flags) -> bool {
        let mut ended = false;
        for lane in 0..lanes.min(WIDEST) {
            let (time, end_time) = (self.time[lane], self.end_time[lane]);
            self.time[lane] = if accepted[lane] { end_time } else { time };
            ended |= accepted[lane] & self.last[lane];
        }
        ended
    }

    /// Returns the next output time of a lane if it lies within the step. `times` returns the
    /// output times of a trajectory.
    #[inline(always)]
    pub(super) fn next_sample<'a>(&self, lane: usize, times: impl Fn(usize) -> &'a [T]) -> Option<T>
    where
        T: 'a,
    {
        let time = *times(self.index[lane]).get(self.sampled[lane])?;
        let left = self.direction[lane] * (self.end_time[lane] - time);
        (left >= T::ZERO).then_some(time)
    }

    /// Allocates the samples of the trajectory in a lane, and takes those at its start time.
    pub(super) fn sample_start(&mut self, lane: usize, times: &[T], values: &[T]) {
        self.samples[lane].reserve_exact(times.len() * values.len());
        while times.get(self.sampled[lane]) == Some(&self.time[lane]) {
            self.sample(lane, values);
        }
    }

    /// Stores the next sample of the trajectory in a lane.
    pub(super) fn sample(&mut self, lane: usize, values: &[T]) {
        self.samples[lane].extend_from_slice(values);
        self.sampled[lane] += 1;
    }

    /// Returns the report of the trajectory in a lane.
    pub(crate) fn report(&self, lane: usize) -> Report<T> {
        Report {
            accepted: self.accepted[lane],
            rejected: self.rejected[lane],
            evaluations: self.evaluations[lane],
            shortest_step: self.shortest[lane],
            longest_step: self.longest[lane],
            next_step: self.next_step[lane],
            stop: StopReason::EndReached,
        }
    }

    /// Ends the trajectory in a lane with an error; `last` is the last good state.
    #[cold]
    pub(crate) fn fail(&mut self, lane: usize, failure: Failure<T>, last: State<T>) {
        let end = Err(failure.error(last, &self.report(lane)));
        let (index, samples) = self.leave(lane);
        self.failed.push((lane, index, Outcome { end, samples }));
    }

    /// Ends the trajectory in a lane because its state or rates are not finite at the given time
    /// and state; `last` is the last good state.
    #[cold]
    pub(crate) fn non_finite(&mut self, lane: usize, (time, values): (T, Vec<T>), last: State<T>) {
        self.fail(lane, NonFinite { time, values }.into(), last);
    }

    /// Ends the trajectory in a lane because the function of an event returned NaN; `last` is the
    /// last good state.
    #[cold]
    pub(super) fn undefined(&mut self, lane: usize, event: usize, time: T, last: State<T>) {
        let report = Report {
            stop: StopReason::NonFinite,
            ..self.report(lane)
        };
        let end = Err(IntegrationError::Event {
            event,
            time,
            last,
            report,
        });
        let (index, samples) = self.leave(lane);
        self.failed.push((lane, index, Outcome { end, samples }));
    }

    /// Ends the trajectory in a lane at an event, at this time and in this state.
    #[cold]
    pub(super) fn stop(&mut self, lane: usize, time: T, values: Vec<T>) {
        let report = Report {
            stop: StopReason::StoppedByEvent,
            ..self.report(lane)
        };
        let state = State { time, values };
        let (index, samples) = self.leave(lane);
        let end = Ok(Solution { state, report });
        self.failed.push((lane, index, Outcome { end, samples }));
    }

    /// Takes the next trajectory that failed or was stopped and has not been reported yet.
    #[inline(always)]
    pub(super) fn take_failed(&mut self) -> Option<(usize, usize, Outcome<T>)> {
        self.failed.pop()
    }

    /// Removes a trajectory that has reached its end from its lane. Returns its index and outcome.
    pub(super) fn finish(&mut self, lane: usize, values: Vec<T>) -> (usize, Outcome<T>) {
        let time = self.time[lane];
        let end = Ok(Solution {
            state: State { time, values },
            report: self.report(lane),
        });
        let (index, samples) = self.leave(lane);
        (index, Outcome { end, samples })
    }
}
