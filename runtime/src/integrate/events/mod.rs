//! Events: zero crossings of functions of time and state.

mod search;

use core::borrow::Borrow;
use core::fmt;
use core::ops::ControlFlow;

#[cfg(feature = "std")]
pub(super) use self::search::SearchedStep;
pub(super) use self::search::{CrossingSearch, SearchError};
use super::error::{IntegrationError, RunError};
use super::report::{Solution, StopReason};
use super::run::Run;
use super::steps::Steps;
use crate::scalar::Real;
use crate::system::Ode;

/// Direction of the zero crossings that count as events, seen in the direction of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both directions.
    Either,
}

/// A function of time and state whose zero crossings are searched for.
#[derive(Clone, Copy)]
pub struct Event<'a, T> {
    function: &'a dyn Fn(T, &[T]) -> T,
    crossing: Crossing,
    checks: u32,
    terminal: u32,
}

impl<'a, T: Real> Event<'a, T> {
    /// Creates an event: the zero crossings of `function(time, state)` in the direction `crossing`.
    ///
    /// The sign is checked at eight times per step. Two zeros between neighbouring checks are not
    /// found.
    pub fn new(crossing: Crossing, function: &'a dyn Fn(T, &[T]) -> T) -> Self {
        Self {
            function,
            crossing,
            checks: 8,
            terminal: 0,
        }
    }

    /// Ends the run at occurrence number `number`, as SciPy's `terminal` does: 1 is the first, 0
    /// never ends it. Each run starts counting at zero.
    pub fn with_terminal(self, number: u32) -> Self {
        Self {
            terminal: number,
            ..self
        }
    }

    /// Sets the number of equidistant times per step at which the sign is checked, the last one at
    /// the end of the step; zero counts as one. If only the end is checked, steps without a change
    /// of sign need no dense output.
    pub fn with_checks(self, checks: u32) -> Self {
        Self {
            checks: checks.max(1),
            ..self
        }
    }
}

impl<T> fmt::Debug for Event<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            function: _,
            crossing,
            checks,
            terminal,
        } = self;
        formatter
            .debug_struct("Event")
            .field("crossing", crossing)
            .field("checks", checks)
            .field("terminal", terminal)
            .finish_non_exhaustive()
    }
}

/// A zero crossing that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occurrence<'a, T> {
    /// Index of the event in the list of events.
    pub event: usize,
    /// Time just after the crossing: within a few rounding errors after the zero of the dense
    /// output. Zeros that are closer together than that get the same time, which is after all of
    /// them.
    pub time: T,
    /// State at that time, from the dense output.
    pub state: &'a [T],
    /// True if the function crosses zero from negative to positive.
    pub rising: bool,
}

impl<B: Borrow<O>, O: Ode<T> + ?Sized, S: Steps<T, O>, T: Real> Run<B, O, S, T> {
    /// Continues the run to the time `end` and reports the events in between.
    pub(super) fn find<E>(
        mut self,
        end: T,
        events: &[Event<'_, T>],
        mut visit: impl FnMut(Occurrence<'_, T>) -> Result<ControlFlow<()>, E>,
    ) -> Result<Solution<T>, RunError<T, E>> {
        let mut search = CrossingSearch::new(events, self.state());
        let goal = self.goal(end);
        while let Some(mut step) = self.step_to(goal)? {
            let (time, flow) = match search.visit(&mut step, &mut visit) {
                Ok(None) => continue,
                Ok(Some(stop)) => stop,
                Err(SearchError::Dense(error)) => return Err(self.dense_failure(error).into()),
                Err(SearchError::Undefined { event, time }) => {
                    let Solution { state, report } = self.solution(StopReason::NonFinite);
                    let error = IntegrationError::Event {
                        event,
                        time,
                        last: state,
                        report,
                    };
                    return Err(error.into());
                }
            };
            flow.map_err(|error| self.stopped_at(time, &search.state, error))?;
            let mut solution = self.solution(StopReason::StoppedByEvent);
            solution.state.time = time;
            solution.state.values.copy_from_slice(&search.state);
            return Ok(solution);
        }
        Ok(self.solution(StopReason::EndReached))
    }
}
