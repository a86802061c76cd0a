//! What all methods have in common.

use core::ops::ControlFlow;

use super::dense::{DenseError, DenseStep};
use super::error::IntegrationError;
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
/// use core::ops::ControlFlow;
/// use branched_pendulum::prelude::*;
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
