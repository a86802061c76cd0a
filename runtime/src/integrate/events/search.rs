//! Search for zero crossings of event functions during a run.

use alloc::vec::Vec;
use core::ops::ControlFlow;

use super::{Crossing, Event, Occurrence};
use crate::integrate::dense::{DenseError, DenseStep};
use crate::scalar::Real;

/// Number of rounding errors within which two times count as the same, and within which a zero
/// counts as that of the start. The second limit is smaller, so that an event missed at the end of
/// one run is found at the start of the next.
const ONE_TIME: f64 = 8.0;
const AT_START: f64 = 4.0;

/// Fractions of the distance to the next check at which it is tested if a function has left a zero.
/// They are large enough that rounding does not decide the result for a function that leaves
/// quadratically.
const DEPARTURES: [f64; 3] = [1.0 / 8192.0, 1.0 / 512.0, 1.0 / 32.0];

/// Number of times that are tried to find one at which several functions are all past their zeros.
const MEETINGS: u32 = 8;

/// An accepted step in which crossings are searched for: a step of a single run, or of one lane.
pub(in crate::integrate) trait SearchedStep<T> {
    /// Returns the times at the start and at the end of the step.
    fn ends(&self) -> [T; 2];

    /// Writes the solution at a time within the step. At the ends this is the state there.
    ///
    /// # Errors
    /// [`DenseError`] if the step has no value at this time.
    fn value(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>>;
}

impl<T: Real> SearchedStep<T> for DenseStep<'_, T> {
    fn ends(&self) -> [T; 2] {
        [self.start_time(), self.end_time()]
    }

    fn value(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        self.eval(time, out)
    }
}

/// Reason why a step could not be searched for crossings.
pub(in crate::integrate) enum SearchError<T> {
    /// The dense output has no value at a time in the step.
    Dense(DenseError<T>),
    /// The function of an event returned NaN.
    Undefined { event: usize, time: T },
}

impl<T> From<DenseError<T>> for SearchError<T> {
    fn from(error: DenseError<T>) -> Self {
        Self::Dense(error)
    }
}

/// A crossing found within the current step.
#[derive(Clone, Copy, Debug)]
struct Found<T> {
    event: usize,
    time: T,
    rising: bool,
}

/// State of the search for crossings along a run.
pub(in crate::integrate) struct CrossingSearch<'a, T> {
    events: &'a [Event<'a, T>],
    /// Number of occurrences of each event up to now.
    counts: Vec<u32>,
    /// Last value of each function.
    values: Vec<T>,
    /// True once `values` are set.
    begun: bool,
    /// Crossings that were found in the current step.
    found: Vec<Found<T>>,
    /// State at the last time at which the step was evaluated.
    pub(in crate::integrate) state: Vec<T>,
}

/// A time within the step, with the value of an event's function there.
#[derive(Clone, Copy)]
struct EventSample<T> {
    time: T,
    value: T,
}

impl<'a, T: Real> CrossingSearch<'a, T> {
    pub(in crate::integrate) fn new(events: &'a [Event<'a, T>], state: &[T]) -> Self {
        Self {
            events,
            counts: alloc::vec![0; events.len()],
            values: alloc::vec![T::ZERO; events.len()],
            begun: false,
            found: Vec::new(),
            state: state.to_vec(),
        }
    }

    /// Visits the crossings within `step`. If an event is terminal or the visitor returns an error,
    /// returns the time at which the run ends; the state of the search is then the state at that
    /// time. All crossings at that time are visited first.
    #[allow(clippy::type_complexity)]
    pub(in crate::integrate) fn visit<E>(
        &mut self,
        step: &mut dyn SearchedStep<T>,
        visit: &mut impl FnMut(Occurrence<'_, T>) -> Result<ControlFlow<()>, E>,
    ) -> Result<Option<(T, Result<(), E>)>, SearchError<T>> {
        self.step(step)?;
        let mut first = 0;
        while first < self.found.len() {
            let (time, next) = self.meet(first, step)?;
            let mut stop = false;
            for &Found { event, rising, .. } in &self.found[first..next] {
                let flow = visit(Occurrence {
                    event,
                    time,
                    state: &self.state,
                    rising,
                });
                let count = &mut self.counts[event];
                *count = count.saturating_add(1);
                match flow {
                    Ok(flow) => stop |= flow.is_break() || *count == self.events[event].terminal,
                    Err(error) => return Ok(Some((time, Err(error)))),
                }
            }
            if stop {
                return Ok(Some((time, Ok(()))));
            }
            first = next;
        }
        Ok(None)
    }

    /// Returns the common time of all crossings that coincide with crossing number `first` up to
    /// rounding, and the index after the last of them. The state becomes the state at this time.
    ///
    /// At this time their functions are past their zeros, but functions that cross later in the
    /// step are not. So a run that starts at this time reports no crossing twice and misses none.
    fn meet(
        &mut self,
        first: usize,
        step: &mut dyn SearchedStep<T>,
    ) -> Result<(T, usize), SearchError<T>> {
        let start = self.found[first].time;
        let near = rounding(ONE_TIME, start);
        let at_once = |found: &&Found<T>| (found.time - start).abs() <= near;
        let mut next = first + self.found[first..].iter().take_while(at_once).count();
        let mut time = self.found[next - 1].time;
        step.value(time, &mut self.state)?;
        if first + 1 == self.found.len() {
            return Ok((time, next));
        }
        let [begin, end] = step.ends();
        let length = end - begin;
        let mut hop = near.max(T::EPSILON * length.abs()).min(length.abs());
        for _ in 0..MEETINGS {
            if self.are_behind(first, &mut next, time, step)? || time == end {
                break;
            }
            let further = if length > T::ZERO {
                time + hop
            } else {
                time - hop
            };
            // Compared in the direction of the step.
            let is_beyond = (further - end) * length > T::ZERO;
            time = if is_beyond { end } else { further };
            hop = hop + hop;
        }
        Ok((time, next))
    }

    /// Returns true if the functions of the crossings from `first` to `next` are past their zeros
    /// at `time`. Crossings whose functions are also past their zeros are added to this range.
    fn are_behind(
        &mut self,
        first: usize,
        next: &mut usize,
        time: T,
        step: &mut dyn SearchedStep<T>,
    ) -> Result<bool, SearchError<T>> {
        let mut all = true;
        for index in first..self.found.len() {
            let Found { event, rising, .. } = self.found[index];
            // For each event: its last crossing in the range, or its first one after the range.
            let others = if index < *next {
                index + 1..*next
            } else {
                first..index
            };
            if self.found[others].iter().any(|other| other.event == event) {
                continue;
            }
            let value = self.value(event, time, step)?;
            let behind = match rising {
                true => value >= T::ZERO,
                false => value <= T::ZERO,
            };
            if index < *next {
                all &= behind;
            } else if behind {
                self.found[*next..=index].rotate_right(1);
                *next += 1;
            }
        }
        Ok(all)
    }

    /// Finds the crossings within `step`, in the order of the run.
    fn step(&mut self, step: &mut dyn SearchedStep<T>) -> Result<(), SearchError<T>> {
        self.found.clear();
        let [start, end] = step.ends();
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
                left = self.leave(index, left, time, step)?;
                let value = self.value(index, time, step)?;
                let right = EventSample { time, value };
                self.record_crossing(index, left, right, step)?;
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

    /// Evaluates an event's function at a time within the step.
    fn value(
        &mut self,
        event: usize,
        time: T,
        step: &mut dyn SearchedStep<T>,
    ) -> Result<T, SearchError<T>> {
        step.value(time, &mut self.state)?;
        let value = (self.events[event].function)(time, &self.state);
        // An infinite value has a sign, NaN has none.
        match value.partial_cmp(&T::ZERO) {
            Some(_) => Ok(value),
            None => Err(SearchError::Undefined { event, time }),
        }
    }

    /// Returns a time just after `left` at which the function has left its zero. Returns `left`
    /// itself if the function is not zero there, or if it stays zero.
    fn leave(
        &mut self,
        event: usize,
        left: EventSample<T>,
        right: T,
        step: &mut dyn SearchedStep<T>,
    ) -> Result<EventSample<T>, SearchError<T>> {
        if left.value != T::ZERO {
            return Ok(left);
        }
        for part in DEPARTURES {
            let time = left.time + T::from_f64(part) * (right - left.time);
            let value = self.value(event, time, step)?;
            if value != T::ZERO {
                return Ok(EventSample { time, value });
            }
        }
        Ok(left)
    }

    /// Records the crossing between `left` and `right`, if there is one in the requested direction
    /// and it is not at the start of the run.
    fn record_crossing(
        &mut self,
        event: usize,
        left: EventSample<T>,
        right: EventSample<T>,
        step: &mut dyn SearchedStep<T>,
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
            let [start, _] = step.ends();
            if self.begun || (time - start).abs() > rounding(AT_START, start) {
                self.found.push(Found {
                    event,
                    time,
                    rising,
                });
            }
        }
        Ok(())
    }

    /// Narrows the interval that contains a crossing as far as rounding allows, and returns its
    /// later end. Uses the secant method with weighted ends (Illinois), and bisection if the
    /// interval shrinks by less than half.
    fn locate(
        &mut self,
        event: usize,
        mut left: EventSample<T>,
        mut right: EventSample<T>,
        step: &mut dyn SearchedStep<T>,
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

/// Returns `units` times the rounding error of a time.
fn rounding<T: Real>(units: f64, time: T) -> T {
    T::from_f64(units) * T::EPSILON * time.abs()
}
