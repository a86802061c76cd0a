//! Time up to which the start of a motion determines the computed result.

use alloc::vec::Vec;

use super::dense::DenseStep;
use super::error::IntegrationError;
use super::integrator::Integrator;
use super::run::Run;
use super::steps::{Goal, Steps};
use crate::scalar::Real;
use crate::system::{Ode, State};

/// Comparison of a computed motion with a second computation, by a finer method and from a start
/// that differs by a few rounding errors.
///
/// A chaotic motion amplifies both the errors of its steps and the rounding of its start: from some
/// time on the two results have no digit in common, and both are meaningless.
///
/// # Examples
///
/// A rod that is released upside down falls over because π is rounded:
///
/// ```
/// use branched_pendulum::integrate::Horizon;
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{OdeFn, RatesOnly};
///
/// let rod = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     (rates[0], rates[1]) = (y[1], -9.81 * y[0].sin());
/// });
/// let [method, finer] = [1e-9, 1e-11].map(|own| Method::Dop853.with(own));
/// let horizon = |start: f64| {
///     let start = State::at_rest(0.0, &[start]);
///     Horizon::find([&method, &finer], &RatesOnly(&rod), &start, &[20.0], 1, &[1e-3]).unwrap()
/// };
/// assert_eq!(horizon(0.5).exceeded, [None]);
/// let time = horizon(std::f64::consts::PI).exceeded[0].unwrap();
/// assert!((5.0..15.0).contains(&time), "{time}");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Horizon<T> {
    /// For each given precision, the first of the compared times at which a component differs by
    /// more than it.
    pub exceeded: Vec<Option<T>>,
    /// Differences at the last time, one for each component that was compared; `None` if the
    /// comparison ended before, because all precisions were exceeded.
    pub at_end: Option<Vec<T>>,
}

/// Difference between the starts of the two compared runs, in units of the rounding error.
const APART: f64 = 4.0;

impl<T: Real> Horizon<T> {
    /// Computes a motion by a method and by a finer one, and compares the first `components` of the
    /// states at the ends of the method's steps and at `times`. The steps are those of
    /// [`Integrator::sample`] to the last of the times, so that chaos between two output times is
    /// noticed where it begins. Ends when the differences exceed all `precisions`.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] of one of the two runs.
    pub fn find<M, O>(
        [method, finer]: [&M; 2],
        ode: &O,
        start: &State<T>,
        times: &[T],
        components: usize,
        precisions: &[T],
    ) -> Result<Self, IntegrationError<T>>
    where
        M: Integrator<T, O>,
        O: Ode<T> + ?Sized,
    {
        let factor = T::ONE + T::from_f64(APART) * T::EPSILON;
        let mut apart = start.clone();
        for value in &mut apart.values {
            *value = factor * *value;
        }
        let end = times.last().copied().unwrap_or(start.time);
        let mut run = Run::new(method, ode, start, times)?;
        let mut second = Run::new(finer, ode, &apart, times)?;
        let goals = [run.goal(end), second.goal(end)];
        let mut found = Self {
            exceeded: alloc::vec![None; precisions.len()],
            at_end: Some(alloc::vec![T::ZERO; components.min(start.values.len())]),
        };
        let states = [&start.values, &apart.values].map(|values| &values[..]);
        found.compare(start.time, states, precisions);
        let (mut values, mut other) = (start.values.clone(), apart.values.clone());
        let mut pending = times.iter().copied().peekable();
        while pending.next_if(|&time| time == start.time).is_some() {}
        while let Some(mut step) = run.step_to(goals[0])? {
            let step_end = step.end_time();
            loop {
                let time = pending.next_if(|&time| step.contains(time));
                let is_last = time.is_none();
                let time = time.unwrap_or(step_end);
                if let Err(error) = step.eval(time, &mut values) {
                    return Err(run.dense_failure(error));
                }
                value_at(&mut second, goals[1], time, &mut other)?;
                found.compare(time, [&values, &other], precisions);
                if found.exceeded.iter().all(Option::is_some) {
                    found.at_end = None;
                    return Ok(found);
                }
                if is_last {
                    break;
                }
            }
        }
        Ok(found)
    }

    /// Compares two states at a time.
    fn compare(&mut self, time: T, [one, other]: [&[T]; 2], precisions: &[T]) {
        let differences = self.at_end.iter_mut().flatten();
        let both = one.iter().zip(other);
        for (difference, (one, other)) in differences.zip(both) {
            *difference = (*one - *other).abs();
        }
        for (first, precision) in self.exceeded.iter_mut().zip(precisions) {
            let mut differences = self.at_end.iter().flatten();
            // NaN is no agreement.
            let is_within = differences.all(|difference| difference <= precision);
            if first.is_none() && !is_within {
                *first = Some(time);
            }
        }
    }
}

/// Continues a run up to a time, and writes the state there to `out`.
fn value_at<O, S, T>(
    run: &mut Run<&O, O, S, T>,
    goal: Goal<T>,
    time: T,
    out: &mut [T],
) -> Result<(), IntegrationError<T>>
where
    O: Ode<T> + ?Sized,
    S: Steps<T, O>,
    T: Real,
{
    while (time - run.time()) * goal.direction > T::ZERO {
        run.step(goal)?;
    }
    match DenseStep::new(run).eval(time, out) {
        Ok(()) => Ok(()),
        Err(error) => Err(run.dense_failure(error)),
    }
}
