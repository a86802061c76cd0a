//! Zero crossings of functions of time and state.

use alloc::vec::Vec;
use core::fmt;

use super::dense::{DenseError, DenseStep};
use crate::scalar::Real;

/// Which zero crossings of a function count, seen along the run: backwards in
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
pub(super) enum SearchError<T> {
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
pub(super) struct Found<T> {
    pub(super) event: usize,
    pub(super) time: T,
    pub(super) rising: bool,
}

/// The search along a run.
pub(super) struct Search<'a, T> {
    events: &'a [Event<'a, T>],
    /// Last value of each function; zero has no side, so that nothing is
    /// reported where a run starts on a zero.
    values: Vec<T>,
    /// True once `values` are set.
    begun: bool,
    /// Crossings of the current step, in their order along the run.
    pub(super) found: Vec<Found<T>>,
    /// State at the last place looked at.
    pub(super) state: Vec<T>,
}

/// A place of a step and the value of a function there.
#[derive(Clone, Copy)]
struct Place<T> {
    time: T,
    value: T,
}

impl<'a, T: Real> Search<'a, T> {
    pub(super) fn new(events: &'a [Event<'a, T>], state: &[T]) -> Self {
        Self {
            events,
            values: alloc::vec![T::ZERO; events.len()],
            begun: false,
            found: Vec::new(),
            state: state.to_vec(),
        }
    }

    /// Finds the crossings within `step`, in their order.
    pub(super) fn step(&mut self, step: &mut DenseStep<'_, T>) -> Result<(), SearchError<T>> {
        self.found.clear();
        let (start, end) = (step.start_time(), step.end_time());
        for index in 0..self.events.len() {
            let checks = self.events[index].checks;
            let value = if self.begun {
                self.values[index]
            } else {
                self.value(index, start, step)?
            };
            let mut left = Place { time: start, value };
            for check in 1..=checks {
                let time = if check == checks {
                    end
                } else {
                    let part = T::from_f64(f64::from(check) / f64::from(checks));
                    start + part * (end - start)
                };
                let value = self.value(index, time, step)?;
                let right = Place { time, value };
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
        left: Place<T>,
        right: Place<T>,
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
        mut left: Place<T>,
        mut right: Place<T>,
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
                left = Place { time, value };
                if kept_right {
                    right.value = half * right.value;
                }
                (kept_left, kept_right) = (false, true);
            } else {
                right = Place { time, value };
                if kept_left {
                    left.value = half * left.value;
                }
                (kept_left, kept_right) = (true, false);
            }
            bisect = (right.time - left.time).abs() > half * width;
        }
    }
}
