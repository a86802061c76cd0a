//! The search for zero crossings along a run.

use alloc::vec::Vec;
use core::ops::ControlFlow;

use super::{Crossing, Event, Occurrence};
use crate::integrate::dense::{DenseError, DenseStep};
use crate::scalar::Real;

/// Units of rounding within which two times are one, and within which a zero is that of
/// the start: fewer, so that what is not told at the end of a run is told after it.
const ONE_TIME: f64 = 8.0;
const AT_START: f64 = 4.0;

/// Parts of the way to the next place looked at, by which a function has left a zero: not
/// so near that rounding decides, where it leaves as a square.
const DEPARTURES: [f64; 3] = [1.0 / 8192.0, 1.0 / 512.0, 1.0 / 32.0];

/// Places at which several functions are asked whether all are behind their zeros.
const MEETINGS: u32 = 8;

/// An accepted step within which crossings are looked for: one of a run, or one in a lane.
pub(in crate::integrate) trait SearchedStep<T> {
    /// Times at its start and at its end.
    fn ends(&self) -> [T; 2];

    /// Writes the solution at a time within the step: at its ends the state there.
    ///
    /// # Errors
    /// [`DenseError`] where the step has no value.
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

/// Why a step could not be searched.
pub(in crate::integrate) enum SearchError<T> {
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
pub(in crate::integrate) struct CrossingSearch<'a, T> {
    events: &'a [Event<'a, T>],
    /// Number of occurrences of each so far.
    counts: Vec<u32>,
    /// Last value of each function.
    values: Vec<T>,
    /// True once `values` are set.
    begun: bool,
    /// Crossings of the current step, in their order along the run.
    found: Vec<Found<T>>,
    /// State at the last place looked at.
    pub(in crate::integrate) state: Vec<T>,
}

/// A place of a step and the value of a function there.
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

    /// Visits the crossings within `step`. Returns the time of the one at which the run
    /// is to end, the state there being that of the search, and why: it is asked for, or
    /// the visitor failed. Others at that time have been visited too.
    #[allow(clippy::type_complexity)]
    pub(in crate::integrate) fn visit<E>(
        &mut self,
        step: &mut impl SearchedStep<T>,
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

    /// The time of the crossings from `first` on that are at one time, to rounding, and
    /// the place behind the last of them. The state becomes that of this time.
    ///
    /// There their functions are behind their zeros, and no others are whose crossings
    /// come later in the step: a run that starts there tells none twice and loses none.
    fn meet(
        &mut self,
        first: usize,
        step: &mut impl SearchedStep<T>,
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
            // In the direction of the step.
            let is_beyond = (further - end) * length > T::ZERO;
            time = if is_beyond { end } else { further };
            hop = hop + hop;
        }
        Ok((time, next))
    }

    /// Returns true if the functions of the crossings from `first` to `next` are behind
    /// their zeros at `time`. Others that are join them.
    fn are_behind(
        &mut self,
        first: usize,
        next: &mut usize,
        time: T,
        step: &mut impl SearchedStep<T>,
    ) -> Result<bool, SearchError<T>> {
        let mut all = true;
        for index in first..self.found.len() {
            let Found { event, rising, .. } = self.found[index];
            // Of each event, the last crossing that is told, or the first one that is not.
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

    /// Finds the crossings within `step`, in their order.
    fn step(&mut self, step: &mut impl SearchedStep<T>) -> Result<(), SearchError<T>> {
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
        step: &mut impl SearchedStep<T>,
    ) -> Result<T, SearchError<T>> {
        step.value(time, &mut self.state)?;
        let value = (self.events[event].function)(time, &self.state);
        // An infinite value has a sign; NaN has none.
        match value.partial_cmp(&T::ZERO) {
            Some(_) => Ok(value),
            None => Err(SearchError::Undefined { event, time }),
        }
    }

    /// A place behind `left` where the function is on the side to which it leaves a zero
    /// there; `left` itself where it is none, or where it stays.
    fn leave(
        &mut self,
        event: usize,
        left: EventSample<T>,
        right: T,
        step: &mut impl SearchedStep<T>,
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

    /// Notes the crossing between two places, if there is one that counts and that is not
    /// at the start of the run.
    fn look(
        &mut self,
        event: usize,
        left: EventSample<T>,
        right: EventSample<T>,
        step: &mut impl SearchedStep<T>,
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

    /// The end behind the crossing of a bracket that rounding keeps from
    /// shrinking: by secants of weighted ends (Illinois), with a bisection
    /// wherever they halve the bracket too slowly.
    fn locate(
        &mut self,
        event: usize,
        mut left: EventSample<T>,
        mut right: EventSample<T>,
        step: &mut impl SearchedStep<T>,
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

/// So many units of rounding of a time.
fn rounding<T: Real>(units: f64, time: T) -> T {
    T::from_f64(units) * T::EPSILON * time.abs()
}
