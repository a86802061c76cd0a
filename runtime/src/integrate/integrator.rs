//! The trait that all methods have in common.

use core::ops::ControlFlow;

use super::dense::{DenseError, DenseStep};
use super::error::IntegrationError;
use super::events::{Event, Found, Occurrence, Search, SearchError};
use super::report::{Report, Solution, StopReason};
use super::request::{check_start, check_times};
use crate::scalar::Real;
use crate::system::{Ode, State};

/// A method that can integrate the system `O`.
///
/// The system is a parameter of the trait, not of its functions, so that a
/// method may ask for more than rates: one that works on Taylor coefficients
/// serves the systems that offer them.
///
/// # Examples
///
/// Code that leaves the method to its caller:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// fn at_one<O: Ode<f64>>(method: &impl Integrator<f64, O>, ode: &O)
///     -> Result<f64, IntegrationError<f64>> {
///     let start = State::new(0.0, vec![1.0]);
///     let solution = method.integrate(ode, &start, 1.0, |_| ControlFlow::Continue(()))?;
///     Ok(solution.state.values[0])
/// }
///
/// let growth = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = y[0]);
/// let options = Options::with_tolerance(1e-12);
/// let e = core::f64::consts::E;
/// assert!((at_one(&Dop853::new(options.clone()), &growth)? - e).abs() < 1e-11);
/// assert!((at_one(&Verner98::new(options), &growth)? - e).abs() < 1e-11);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
pub trait Integrator<T: Real, O: Ode<T> + ?Sized> {
    /// Integrates from `start` to the time `end`, which may lie before it.
    ///
    /// `observer` sees every accepted step and ends the run with
    /// [`ControlFlow::Break`]; the last state is then the end of that step. A
    /// span of zero returns the start at once, without an evaluation.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`]: a request that makes no sense, rates that are not
    /// finite, a step that becomes too small, too many steps. All but the
    /// first carry the last good state.
    fn integrate(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        observer: impl FnMut(&mut DenseStep<'_, T>) -> ControlFlow<()>,
    ) -> Result<Solution<T>, IntegrationError<T>>;

    /// Integrates from `start` through the given times, in their order, and
    /// calls `visit` with each time and the state there.
    ///
    /// The states come from the dense output: the steps are those of
    /// [`integrate`](Self::integrate) to the last time, however many times lie
    /// between. Times equal to the start are visited with the start itself;
    /// equal times are visited as often as they stand there. Without times the
    /// start is returned.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate); times must be finite and run one way
    /// from the start. After an error all times up to the last good state have
    /// been visited, unless the rates were not finite within the last step.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
    /// let times = [0.0, 0.5, 1.0, 2.0];
    /// let mut samples = Vec::new();
    /// let solution = Dop853::new(Options::with_tolerance(1e-10)).sample(
    ///     &decay,
    ///     &State::new(0.0, vec![1.0]),
    ///     &times,
    ///     |time, y| samples.push((time, y[0])),
    /// )?;
    /// assert_eq!(samples.len(), times.len());
    /// for (time, y) in samples {
    ///     assert!((y - (-time).exp()).abs() < 1e-9);
    /// }
    /// assert_eq!(solution.state.time, 2.0);
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    fn sample(
        &self,
        ode: &O,
        start: &State<T>,
        times: &[T],
        mut visit: impl FnMut(T, &[T]),
    ) -> Result<Solution<T>, IntegrationError<T>> {
        check_start(ode, start)?;
        check_times(start.time, times)?;
        let end = times.last().copied().unwrap_or(start.time);
        let mut pending = times.iter().copied().peekable();
        let mut values = start.values.clone();
        let mut failure = None;
        let outcome = self.integrate(ode, start, end, |step| {
            while let Some(time) = pending.next_if(|&time| step.contains(time)) {
                match step.eval(time, &mut values) {
                    Ok(()) => visit(time, &values),
                    Err(error) => {
                        failure = Some(error);
                        return ControlFlow::Break(());
                    }
                }
            }
            ControlFlow::Continue(())
        });
        if !matches!(outcome, Err(IntegrationError::Input(_))) {
            // Where no step was made, the start has not been seen.
            while pending.next_if(|&time| time == start.time).is_some() {
                visit(start.time, &start.values);
            }
        }
        let solution = outcome?;
        match failure {
            Some(error) => Err(dense_failure(error, solution)),
            None => Ok(solution),
        }
    }

    /// Integrates from `start` to the time `end` and calls `visit` with every
    /// zero crossing of the functions `events`, in their order along the run.
    ///
    /// [`ControlFlow::Break`] ends the run there: the last state is then that of
    /// the crossing, and a run that starts from it does not report the crossing
    /// again. Nor is one reported where a run starts with a function exactly
    /// zero. A function that only touches zero is reported if one of the places
    /// looked at is a zero exactly.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate), and [`IntegrationError::Event`] where
    /// a function is NaN.
    ///
    /// # Examples
    ///
    /// A Poincaré section: the angle of a pendulum whenever its velocity
    /// changes from positive to negative.
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let pendulum = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
    ///     rates[0] = y[1];
    ///     rates[1] = -y[0].sin();
    /// });
    /// let velocity = |_time: f64, y: &[f64]| y[1];
    /// let turns = [Event::new(Crossing::Falling, &velocity)];
    /// let mut angles = Vec::new();
    /// Dop853::new(Options::with_tolerance(1e-12)).integrate_with_events(
    ///     &pendulum,
    ///     &State::at_rest(0.0, &[1.0]),
    ///     20.0,
    ///     &turns,
    ///     |turn| {
    ///         angles.push(turn.state[0]);
    ///         ControlFlow::Continue(())
    ///     },
    /// )?;
    /// assert_eq!(angles.len(), 2);
    /// assert!(angles.iter().all(|angle| (angle - 1.0).abs() < 1e-11));
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    fn integrate_with_events(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        events: &[Event<'_, T>],
        mut visit: impl FnMut(Occurrence<'_, T>) -> ControlFlow<()>,
    ) -> Result<Solution<T>, IntegrationError<T>> {
        let mut search = Search::new(events, &start.values);
        let mut outcome = Ok(None);
        let mut solution = self.integrate(ode, start, end, |step| {
            outcome = search_step(&mut search, step, &mut visit);
            match outcome {
                Ok(None) => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        })?;
        match outcome {
            Ok(None) => Ok(solution),
            Ok(Some(time)) => {
                solution.state.time = time;
                solution.state.values.copy_from_slice(&search.state);
                solution.report.stop = StopReason::StoppedByEvent;
                Ok(solution)
            }
            Err(SearchError::Dense(error)) => Err(dense_failure(error, solution)),
            Err(SearchError::Undefined { event, time }) => Err(IntegrationError::Event {
                event,
                time,
                last: solution.state,
                report: Report {
                    stop: StopReason::NonFinite,
                    ..solution.report
                },
            }),
        }
    }
}

/// Visits the crossings within `step`; gives the time of the one at which the
/// run is to end, the state there being that of the search.
fn search_step<T: Real>(
    search: &mut Search<'_, T>,
    step: &mut DenseStep<'_, T>,
    visit: &mut impl FnMut(Occurrence<'_, T>) -> ControlFlow<()>,
) -> Result<Option<T>, SearchError<T>> {
    search.step(step)?;
    for index in 0..search.found.len() {
        let Found {
            event,
            time,
            rising,
        } = search.found[index];
        step.eval(time, &mut search.state)?;
        let flow = visit(Occurrence {
            event,
            time,
            state: &search.state,
            rising,
        });
        if flow.is_break() {
            return Ok(Some(time));
        }
    }
    Ok(None)
}

/// The end of a run that `solution` describes, whose last step had no value to
/// give: time and length were right, so the rates were not finite.
pub(crate) fn dense_failure<T: Real>(
    error: DenseError<T>,
    solution: Solution<T>,
) -> IntegrationError<T> {
    let (time, values) = match error {
        DenseError::NonFinite { time, values } => (time, values),
        DenseError::OutsideStep { .. } | DenseError::Length { .. } => {
            (solution.state.time, solution.state.values.clone())
        }
    };
    IntegrationError::NonFinite {
        time,
        values,
        last: solution.state,
        report: Report {
            stop: StopReason::NonFinite,
            ..solution.report
        },
    }
}
