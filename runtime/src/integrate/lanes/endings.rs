//! Conditions that end a trajectory in a lane of a vector register.

use alloc::vec::Vec;
use core::convert::Infallible;
use core::fmt;
use core::ops::ControlFlow;

use super::method::LaneSteps;
use super::runs::{Flags, Runs};
use crate::integrate::dense::DenseError;
use crate::integrate::events::{
    Crossing, CrossingSearch, Event, Occurrence, SearchError, SearchedStep,
};
use crate::integrate::registers::{Numbers, WIDEST, copy_lane, numbers_in, register};
use crate::integrate::right_hand_side::StepSpan;
use crate::scalar::{Lane, Real};
use crate::simd::Simd;
use crate::system::State;

/// A condition that ends a trajectory in a lane: the first zero crossing of a function of time and
/// state. It corresponds to a terminal [`Event`] of a single run, and is used by
/// [`Ensemble::integrate_in_lanes_until`](crate::ensemble::Ensemble::integrate_in_lanes_until).
#[derive(Clone, Copy)]
pub struct Ending<'a, T> {
    function: &'a (dyn Fn(T, &[T]) -> T + Sync),
    crossing: Crossing,
    checks: u32,
}

impl<'a, T: Real> Ending<'a, T> {
    /// Creates the condition: the first zero crossing of `function(time, state)` in the direction
    /// `crossing`.
    ///
    /// The sign is checked at eight times a step. Two zeros between neighbouring checks are not
    /// found.
    pub fn new(crossing: Crossing, function: &'a (dyn Fn(T, &[T]) -> T + Sync)) -> Self {
        Self {
            function,
            crossing,
            checks: 8,
        }
    }

    /// Sets the number of equidistant times per step at which the sign is checked, the last one at
    /// the end of the step; zero counts as one. If only the end is checked, steps without a change
    /// of sign need no dense output.
    pub fn with_checks(self, checks: u32) -> Self {
        Self { checks, ..self }
    }

    fn event(&self) -> Event<'a, T> {
        let event = Event::new(self.crossing, self.function);
        event.with_checks(self.checks).with_terminal(1)
    }
}

impl<T> fmt::Debug for Ending<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            function: _,
            crossing,
            checks,
        } = self;
        formatter
            .debug_struct("Ending")
            .field("crossing", crossing)
            .field("checks", checks)
            .finish_non_exhaustive()
    }
}

/// Returns the conditions as events.
pub(super) fn events<'a, T: Real>(endings: &[Ending<'a, T>]) -> Vec<Event<'a, T>> {
    endings.iter().map(Ending::event).collect()
}

/// Search for the times at which conditions end the trajectories in the lanes.
pub(super) struct LaneEndings<'a, T, R> {
    events: &'a [Event<'a, T>],
    searches: [Option<CrossingSearch<'a, T>>; WIDEST],
    /// Workspace for one state in each lane.
    values: Vec<R>,
}

impl<'a, T: Lane, R: Simd<T>> LaneEndings<'a, T, R> {
    pub(super) fn new(events: &'a [Event<'a, T>], dimension: usize) -> Self {
        Self {
            events,
            searches: [const { None }; WIDEST],
            values: alloc::vec![R::from_f64(0.0); dimension],
        }
    }

    /// Starts the search for trajectories that have just been put into their lanes.
    pub(super) fn begin(&mut self, steps: &impl LaneSteps<T, R>, fresh: &Flags) {
        for lane in (0..R::LANES).filter(|&lane| fresh[lane]) {
            let start = numbers_in(steps.start(), lane);
            self.searches[lane] = Some(CrossingSearch::new(self.events, &start));
        }
    }

    /// Ends the trajectories whose condition is met within an accepted step, at most one condition
    /// per lane.
    pub(super) fn take(
        &mut self,
        steps: &mut impl LaneSteps<T, R>,
        runs: &mut Runs<T>,
        accepted: &Flags,
        span: StepSpan<R>,
    ) {
        let mut prepared = false;
        for lane in (0..R::LANES).filter(|&lane| accepted[lane]) {
            let Some(search) = self.searches[lane].as_mut().filter(|_| runs.active[lane]) else {
                continue;
            };
            let mut step = StepInLane {
                steps,
                runs,
                values: &mut self.values,
                lane,
                span,
                prepared: &mut prepared,
                judged: false,
            };
            let mut go_on = |_: Occurrence<'_, T>| Ok::<_, Infallible>(ControlFlow::Continue(()));
            let found = search.visit(&mut step, &mut go_on);
            let last = || State {
                time: runs.end_time[lane],
                values: numbers_in(steps.end(), lane),
            };
            match found {
                Ok(None) => {}
                Ok(Some((time, Ok(())))) => runs.stop(lane, time, search.state.clone()),
                Ok(Some((_, Err(never)))) => match never {},
                Err(SearchError::Dense(error)) => {
                    let last = last();
                    let place = match error {
                        DenseError::NonFinite { time, values } => (time, values),
                        DenseError::OutsideStep { .. } | DenseError::Length { .. } => {
                            (last.time, last.values.clone())
                        }
                    };
                    runs.non_finite(lane, place, last);
                }
                Err(SearchError::Undefined { event, time }) => {
                    let last = last();
                    runs.undefined(lane, event, time, last);
                }
            }
        }
    }
}

/// The accepted step of the trajectory in one lane.
struct StepInLane<'s, S, T, R> {
    steps: &'s mut S,
    runs: &'s mut Runs<T>,
    values: &'s mut [R],
    lane: usize,
    span: StepSpan<R>,
    /// True if the dense output of all lanes has been computed.
    prepared: &'s mut bool,
    /// True if the dense output of this lane has been checked to be finite.
    judged: bool,
}

impl<S: LaneSteps<T, R>, T: Lane, R: Simd<T>> SearchedStep<T> for StepInLane<'_, S, T, R> {
    fn ends(&self) -> [T; 2] {
        [self.runs.time[self.lane], self.runs.end_time[self.lane]]
    }

    fn value(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        let lane = self.lane;
        let [start, end] = self.ends();
        if time == end {
            copy_lane(self.steps.end(), lane, out);
            return Ok(());
        }
        if time == start {
            copy_lane(self.steps.start(), lane, out);
            return Ok(());
        }
        if !*self.prepared {
            self.steps.prepare_dense(self.span);
            *self.prepared = true;
        }
        if !self.judged {
            let judged = self.steps.judge_dense(self.runs, lane);
            judged.map_err(|(time, values)| DenseError::NonFinite { time, values })?;
            self.judged = true;
        }
        let mut fraction: Numbers<T> = [T::ZERO; WIDEST];
        fraction[lane] = (time - start) / (end - start);
        self.steps.value(register(&fraction), self.values);
        copy_lane(self.values, lane, out);
        Ok(())
    }
}
