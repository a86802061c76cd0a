//! Zero crossings of functions of time and state.

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

/// The zero crossings of a function that count, seen along the run: backwards in
/// time for a run that goes backwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    Either,
}

/// A function of time and state whose zero crossings are looked for.
#[derive(Clone, Copy)]
pub struct Event<'a, T> {
    function: &'a dyn Fn(T, &[T]) -> T,
    crossing: Crossing,
    checks: u32,
    terminal: u32,
}

impl<'a, T: Real> Event<'a, T> {
    /// The zero crossings of `function(time, state)` in the direction
    /// `crossing`.
    ///
    /// The sign is looked at in eight places a step; two zeros between two of
    /// them are not seen.
    pub fn new(crossing: Crossing, function: &'a dyn Fn(T, &[T]) -> T) -> Self {
        Self {
            function,
            crossing,
            checks: 8,
            terminal: 0,
        }
    }

    /// Ends a run at the occurrence of this number, as SciPy's `terminal` does: 1 is the
    /// first, 0 none. Each run counts anew.
    pub fn with_terminal(self, number: u32) -> Self {
        Self {
            terminal: number,
            ..self
        }
    }

    /// Looks at the sign in `checks` equidistant places a step, one being its
    /// end; zero counts as one. Where only the end is looked at, steps without
    /// a change of sign need no dense output.
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
    /// Index of the event among those asked for.
    pub event: usize,
    /// Time: the first that the search knows behind the crossing, a few units
    /// of rounding from the zero of the dense output. Zeros that are no further than
    /// that from each other have one time, behind all of them.
    pub time: T,
    /// State at that time, by the dense output.
    pub state: &'a [T],
    /// True where the function rises.
    pub rising: bool,
}

impl<B: Borrow<O>, O: Ode<T> + ?Sized, S: Steps<T, O>, T: Real> Run<B, O, S, T> {
    /// Goes on to the time `end` and visits the events on the way.
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
