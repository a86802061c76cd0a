//! Zero crossings of functions of time and state.

use alloc::vec::Vec;
use core::borrow::Borrow;
use core::fmt;
use core::ops::ControlFlow;

use super::dense::{DenseError, DenseStep};
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
        } = self;
        formatter
            .debug_struct("Event")
            .field("crossing", crossing)
            .field("checks", checks)
            .finish_non_exhaustive()
    }
}

/// A zero crossing that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occurrence<'a, T> {
    /// Index of the event among those asked for.
    pub event: usize,
    /// Time: the first that the search knows behind the crossing, a few units
    /// of rounding from the zero of the dense output.
    pub time: T,
    /// State at that time, by the dense output.
    pub state: &'a [T],
    /// True where the function rises.
    pub rising: bool,
}

/// Why a step could not be searched.
enum SearchError<T> {
    /// The step has no value to give.
    Dense(DenseError<T>),
    /// A function is NaN.
    Undefined { event: usize, time: T },
}

impl<T> From<DenseError<T>> for SearchError<T> {
    fn from(error: DenseError<T>) -> Self {
        Self::Dense(error)
    }
}

/// A crossing within the step being searched.
#[derive(Clone, Copy, Debug)]
struct Found<T> {
    event: usize,
    time: T,
    rising: bool,
}

/// The search along a run.
struct Search<'a, T> {
    events: &'a [Event<'a, T>],
    /// Last value of each function; zero has no side, so that nothing is
    /// reported where a run starts on a zero.
    values: Vec<T>,
    /// True once `values` are set.
    begun: bool,
    /// Crossings of the current step, in their order along the run.
    found: Vec<Found<T>>,
    /// State at the last place looked at.
    state: Vec<T>,
}

/// A place of a step and the value of a function there.
#[derive(Clone, Copy)]
struct EventSample<T> {
    time: T,
    value: T,
}

impl<'a, T: Real> Search<'a, T> {
    fn new(events: &'a [Event<'a, T>], state: &[T]) -> Self {
        Self {
            events,
            values: alloc::vec![T::ZERO; events.len()],
            begun: false,
            found: Vec::new(),
            state: state.to_vec(),
        }
    }

    /// Visits the crossings within `step`. Returns the time of the one at which the run
    /// is to end, the state there being that of the search, and why: it is asked for, or
    /// the visitor failed.
    #[allow(clippy::type_complexity)]
    fn visit<E>(
        &mut self,
        step: &mut DenseStep<'_, T>,
        visit: &mut impl FnMut(Occurrence<'_, T>) -> Result<ControlFlow<()>, E>,
    ) -> Result<Option<(T, Result<(), E>)>, SearchError<T>> {
        self.step(step)?;
        for index in 0..self.found.len() {
            let Found {
                event,
                time,
                rising,
            } = self.found[index];
            step.eval(time, &mut self.state)?;
            let flow = visit(Occurrence {
                event,
                time,
                state: &self.state,
                rising,
            });
            match flow {
                Ok(ControlFlow::Continue(())) => {}
                Ok(ControlFlow::Break(())) => return Ok(Some((time, Ok(())))),
                Err(error) => return Ok(Some((time, Err(error)))),
            }
        }
        Ok(None)
    }

    /// Finds the crossings within `step`, in their order.
    fn step(&mut self, step: &mut DenseStep<'_, T>) -> Result<(), SearchError<T>> {
        self.found.clear();
        let (start, end) = (step.start_time(), step.end_time());
        for index in 0..self.events.len() {
            let checks = self.events[index].checks;
            let value = if self.begun {
                self.values[index]
            } else {
                self.value(index, start, step)?
            };
            let mut left = EventSample { time: start, value };
            for check in 1..=checks {
                let time = if check == checks {
                    end
                } else {
                    let part = T::from_f64(f64::from(check) / f64::from(checks));
                    start + part * (end - start)
                };
                let value = self.value(index, time, step)?;
                let right = EventSample { time, value };
                self.look(index, left, right, step)?;
                left = right;
            }
            self.values[index] = left.value;
        }
        self.begun = true;
        let forwards = end > start;
        self.found.sort_by(|a, b| {
            let (a, b) = if forwards { (a, b) } else { (b, a) };
            let order = a.time.partial_cmp(&b.time);
            order.unwrap_or(core::cmp::Ordering::Equal)
        });
        Ok(())
    }

    /// Value of an event's function within the step.
    fn value(
        &mut self,
        event: usize,
        time: T,
        step: &mut DenseStep<'_, T>,
    ) -> Result<T, SearchError<T>> {
        step.eval(time, &mut self.state)?;
        let value = (self.events[event].function)(time, &self.state);
        // An infinite value has a sign; NaN has none.
        match value.partial_cmp(&T::ZERO) {
            Some(_) => Ok(value),
            None => Err(SearchError::Undefined { event, time }),
        }
    }

    /// Notes the crossing between two places, if there is one that counts.
    fn look(
        &mut self,
        event: usize,
        left: EventSample<T>,
        right: EventSample<T>,
        step: &mut DenseStep<'_, T>,
    ) -> Result<(), SearchError<T>> {
        let rising = left.value < T::ZERO && right.value >= T::ZERO;
        let falling = left.value > T::ZERO && right.value <= T::ZERO;
        let counts = match self.events[event].crossing {
            Crossing::Rising => rising,
            Crossing::Falling => falling,
            Crossing::Either => rising || falling,
        };
        if counts {
            let time = self.locate(event, left, right, step)?;
            self.found.push(Found {
                event,
                time,
                rising,
            });
        }
        Ok(())
    }

    /// The end behind the crossing of a bracket that rounding keeps from
    /// shrinking: by secants of weighted ends (Illinois), with a bisection
    /// wherever they halve the bracket too slowly.
    fn locate(
        &mut self,
        event: usize,
        mut left: EventSample<T>,
        mut right: EventSample<T>,
        step: &mut DenseStep<'_, T>,
    ) -> Result<T, SearchError<T>> {
        let half = T::from_f64(0.5);
        let negative = left.value < T::ZERO;
        let (mut bisect, mut kept_left, mut kept_right) = (false, false, false);
        loop {
            let width = (right.time - left.time).abs();
            let rounding = T::EPSILON * left.time.abs().max(right.time.abs());
            let middle = left.time + half * (right.time - left.time);
            if right.value == T::ZERO || width <= rounding || middle == left.time {
                return Ok(right.time);
            }
            let mut time = middle;
            if !bisect {
                let share = left.value / (left.value - right.value);
                let secant = left.time + share * (right.time - left.time);
                if (secant - left.time) * (secant - right.time) < T::ZERO {
                    time = secant;
                }
            }
            if time == right.time {
                return Ok(right.time);
            }
            let value = self.value(event, time, step)?;
            let before = value != T::ZERO && (value < T::ZERO) == negative;
            if before {
                left = EventSample { time, value };
                if kept_right {
                    right.value = half * right.value;
                }
                (kept_left, kept_right) = (false, true);
            } else {
                right = EventSample { time, value };
                if kept_left {
                    left.value = half * left.value;
                }
                (kept_left, kept_right) = (true, false);
            }
            bisect = (right.time - left.time).abs() > half * width;
        }
    }
}

impl<B: Borrow<O>, O: Ode<T> + ?Sized, S: Steps<T, O>, T: Real> Run<B, O, S, T> {
    /// Goes on to the time `end` and visits the events on the way.
    pub(super) fn find<E>(
        mut self,
        end: T,
        events: &[Event<'_, T>],
        mut visit: impl FnMut(Occurrence<'_, T>) -> Result<ControlFlow<()>, E>,
    ) -> Result<Solution<T>, RunError<T, E>> {
        let mut search = Search::new(events, self.state());
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
