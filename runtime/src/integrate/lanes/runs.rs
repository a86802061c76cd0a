//! The trajectories in the lanes: their times, steps, accounts and samples.

// One index into all lanes at once.
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

/// One yes or no a lane.
pub(crate) type Flags = [bool; WIDEST];

/// The end of a trajectory, good or bad.
#[derive(Clone, Debug)]
pub(crate) struct Outcome<T> {
    /// Last state and account of the trajectory, or why it failed.
    pub(crate) end: Result<Solution<T>, IntegrationError<T>>,
    /// The states at the times asked for, one after the other, as far as it came.
    pub(crate) samples: Vec<T>,
}

/// The trajectories under way, number by number and not one by one: what is done
/// for all of them in every step are then short loops without branches.
///
/// In a lane without a trajectory everything is zero.
#[derive(Debug)]
pub struct Runs<T> {
    /// True for the lanes that have a trajectory.
    pub(crate) active: Flags,
    /// Place of each trajectory among the cases.
    index: [usize; WIDEST],
    /// Start of the step.
    pub(crate) time: Numbers<T>,
    /// Where it is to end.
    pub(crate) end: Numbers<T>,
    /// 1, or −1 backwards.
    pub(crate) direction: Numbers<T>,
    /// Length of the step that is tried next.
    pub(crate) step: Numbers<T>,
    /// End of the step that is tried, and its length with its sign.
    pub(crate) end_time: Numbers<T>,
    pub(crate) length: Numbers<T>,
    /// True where that is the end of the trajectory.
    pub(crate) last: Flags,
    pub(crate) accepted: [u64; WIDEST],
    pub(crate) rejected: [u64; WIDEST],
    pub(crate) evaluations: [u64; WIDEST],
    shortest: Numbers<T>,
    longest: Numbers<T>,
    pub(crate) next_step: Numbers<T>,
    samples: [Vec<T>; WIDEST],
    /// Number of times that these belong to.
    sampled: [usize; WIDEST],
    /// Trajectories that have failed or were stopped since one last looked, with their lanes.
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

    /// Puts a trajectory into a lane.
    pub(super) fn begin(&mut self, lane: usize, index: usize, time: T, end: T) {
        self.active[lane] = true;
        self.index[lane] = index;
        self.time[lane] = time;
        self.end[lane] = end;
        self.direction[lane] = if end > time { T::ONE } else { -T::ONE };
    }

    /// One of the trajectories under way, by its place among the cases.
    pub(super) fn any(&self) -> Option<usize> {
        let lane = self.active.iter().position(|&active| active)?;
        Some(self.index[lane])
    }

    /// Takes the trajectory out of a lane, with its samples.
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

    /// Plans the steps of all lanes, of the lengths that the control has chosen. Returns
    /// those that may not be tried.
    #[inline(always)]
    pub(crate) fn plan(&mut self, lanes: usize, limits: &StepLimits<T>) -> Flags {
        let mut stuck = [false; WIDEST];
        for lane in 0..lanes.min(WIDEST) {
            let (time, step) = (self.time[lane], self.step[lane]);
            let (end_time, last) = towards(self.end[lane], self.direction[lane], time, step);
            self.end_time[lane] = end_time;
            // The difference of the rounded times, so that they add up.
            self.length[lane] = end_time - time;
            self.last[lane] = last;
            let steps = self.accepted[lane] + self.rejected[lane];
            stuck[lane] = self.active[lane] & !limits.allow(steps, (time, step, last));
        }
        stuck
    }

    /// Why the step of a lane that is stuck may not be tried.
    pub(crate) fn why_stuck(&self, lane: usize, limits: &StepLimits<T>) -> Option<Failure<T>> {
        let attempt = (self.time[lane], self.step[lane], self.last[lane]);
        limits.check(&self.report(lane), 0, attempt).err()
    }

    /// The step that is tried.
    #[inline(always)]
    pub(crate) fn span(&self, lane: usize) -> StepSpan<T> {
        StepSpan {
            time: self.time[lane],
            step: self.length[lane],
        }
    }

    /// Where the trajectory of a lane is to go.
    #[inline(always)]
    pub(crate) fn goal(&self, lane: usize) -> Goal<T> {
        Goal {
            end: Some(self.end[lane]),
            direction: self.direction[lane],
            steps_before: 0,
        }
    }

    /// Counts the steps that are accepted.
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

    /// Makes the end of the step the start of the next one in lanes whose step
    /// was accepted. Returns whether a trajectory has reached its end.
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

    /// The time of the next sample in a lane, of the `times` of its case, if that is in the step.
    #[inline(always)]
    pub(super) fn next_sample<'a>(&self, lane: usize, times: impl Fn(usize) -> &'a [T]) -> Option<T>
    where
        T: 'a,
    {
        let time = *times(self.index[lane]).get(self.sampled[lane])?;
        let left = self.direction[lane] * (self.end_time[lane] - time);
        (left >= T::ZERO).then_some(time)
    }

    /// Makes room for the samples of a lane, and takes those at the start.
    pub(super) fn sample_start(&mut self, lane: usize, times: &[T], values: &[T]) {
        self.samples[lane].reserve_exact(times.len() * values.len());
        while times.get(self.sampled[lane]) == Some(&self.time[lane]) {
            self.sample(lane, values);
        }
    }

    /// Takes the next sample of a lane.
    pub(super) fn sample(&mut self, lane: usize, values: &[T]) {
        self.samples[lane].extend_from_slice(values);
        self.sampled[lane] += 1;
    }

    /// The account of the trajectory in a lane.
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

    /// Ends the trajectory in a lane; `last` is the last good state.
    #[cold]
    pub(crate) fn fail(&mut self, lane: usize, failure: Failure<T>, last: State<T>) {
        let end = Err(failure.error(last, &self.report(lane)));
        let (index, samples) = self.leave(lane);
        self.failed.push((lane, index, Outcome { end, samples }));
    }

    /// The trajectory in a lane ends because rates or a state are not finite at this
    /// place; `last` is the last good state.
    #[cold]
    pub(crate) fn non_finite(&mut self, lane: usize, (time, values): (T, Vec<T>), last: State<T>) {
        self.fail(lane, NonFinite { time, values }.into(), last);
    }

    /// The trajectory in a lane ends because the function of an event is NaN; `last` is the last
    /// good state.
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

    /// The trajectory in a lane ends at an event, at this time and in this state.
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

    /// Takes out a trajectory that has failed or was stopped, and was not taken yet.
    #[inline(always)]
    pub(super) fn take_failed(&mut self) -> Option<(usize, usize, Outcome<T>)> {
        self.failed.pop()
    }

    /// Takes a trajectory out of its lane that has reached its end.
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
