//! Time up to which the start of a motion determines the computed result.

use alloc::vec::Vec;

use super::error::{IntegrationError, RunError};
use super::integrator::Integrator;
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
/// let times: Vec<f64> = (0..=200).map(|k| 0.1 * f64::from(k)).collect();
/// let [method, finer] = [1e-9, 1e-11].map(|own| Method::Dop853.with(own));
/// let horizon = |start: f64| {
///     let start = State::at_rest(0.0, &[start]);
///     let samples = method.sample_to_vec(&RatesOnly(&rod), &start, &times).unwrap();
///     let samples = samples.iter().map(|state| &state.values[..1]);
///     Horizon::find(&finer, &RatesOnly(&rod), &start, &times, samples, &[1e-3]).unwrap()
/// };
/// assert_eq!(horizon(0.5).exceeded, [None]);
/// let time = horizon(std::f64::consts::PI).exceeded[0].unwrap();
/// assert!((5.0..15.0).contains(&time), "{time}");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Horizon<T> {
    /// For each given precision, the first time at which a component differs by more than it.
    pub exceeded: Vec<Option<T>>,
    /// Differences at the last time, one for each component that was compared; `None` if the
    /// comparison ended before, because all precisions were exceeded.
    pub at_end: Option<Vec<T>>,
}

/// Difference between the starts of the two compared runs, in units of the rounding error.
const APART: f64 = 4.0;

/// All precisions are exceeded.
struct Exceeded;

impl<T: Real> Horizon<T> {
    /// Computes the motion again by the method `finer` and compares it with `samples`, the first
    /// components of the states at `times`. Ends when the differences exceed all `precisions`.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] of the second run.
    pub fn find<'a, O: Ode<T> + ?Sized>(
        finer: &impl Integrator<T, O>,
        ode: &O,
        start: &State<T>,
        times: &[T],
        samples: impl IntoIterator<Item = &'a [T]>,
        precisions: &[T],
    ) -> Result<Self, IntegrationError<T>> {
        let factor = T::ONE + T::from_f64(APART) * T::EPSILON;
        let mut apart = start.clone();
        for value in &mut apart.values {
            *value = factor * *value;
        }
        let mut exceeded = alloc::vec![None; precisions.len()];
        let (mut samples, mut at_end) = (samples.into_iter(), Vec::new());
        let run = finer.try_sample(ode, &apart, times, |time, state| {
            at_end.clear();
            let both = samples.next().into_iter().flatten().zip(state);
            at_end.extend(both.map(|(one, other)| (*one - *other).abs()));
            for (first, precision) in exceeded.iter_mut().zip(precisions) {
                // NaN is no agreement.
                let is_within = at_end.iter().all(|difference| difference <= precision);
                if first.is_none() && !is_within {
                    *first = Some(time);
                }
            }
            match exceeded.iter().all(Option::is_some) {
                true => Err(Exceeded),
                false => Ok(()),
            }
        });
        let is_whole = match run {
            Ok(_) => true,
            Err(RunError::Observer {
                error: Exceeded, ..
            }) => false,
            Err(RunError::Integration(error)) => return Err(error),
        };
        Ok(Self {
            exceeded,
            at_end: is_whole.then_some(at_end),
        })
    }
}
