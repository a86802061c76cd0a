//! Errors of integrations: invalid arguments, and runs that end before their end time.

mod input;

use alloc::vec::Vec;
use core::convert::Infallible;
use core::error::Error;
use core::fmt;

use super::report::Report;
use crate::scalar::Real;
use crate::system::State;

pub use input::InputError;

/// Error: an integration ended before its end time.
///
/// Every variant except [`Input`](Self::Input) carries the last state that was reached within the
/// tolerances. A run can be continued from it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrationError<T> {
    /// An argument is invalid. Nothing was computed.
    Input(InputError<T>),
    /// The right-hand side, or the state within a step, became infinite or NaN.
    NonFinite {
        /// Time of the evaluation, usually inside a step.
        time: T,
        /// State at which the rates were evaluated.
        values: Vec<T>,
        /// The last accepted state.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
    /// The tolerances require a step below the shortest step.
    StepTooSmall {
        /// Length of the required step.
        step: T,
        /// Shortest step: the option, or the limit set by the rounding of the time.
        shortest: T,
        /// The last accepted state.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
    /// The equations of an implicit step could not be solved, even after the step was halved
    /// repeatedly.
    NotSolved {
        /// Length of the last step tried.
        step: T,
        /// Number of iterations in the last step tried.
        iterations: u32,
        /// Largest change of a component in the last iteration, relative to the component's size;
        /// NaN if the matrix of Newton's method is singular.
        change: T,
        /// The last accepted state.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
    /// The end of a step could not be projected to the level of a first integral, even after the
    /// step was halved repeatedly.
    NotProjected {
        /// Length of the last step tried.
        step: T,
        /// Number of Newton iterations of the projection.
        iterations: u32,
        /// Value of the integral minus its required value, after the last iteration.
        deviation: T,
        /// The last accepted state.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
    /// The function of an event returned NaN.
    Event {
        /// Index of the event in the list of events.
        event: usize,
        /// Time of the evaluation.
        time: T,
        /// The last accepted state.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
    /// The limit on the number of steps was reached.
    StepLimit {
        /// Largest number of steps.
        limit: u64,
        /// The last accepted state.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
}

impl<T> IntegrationError<T> {
    /// Returns the last state reached within the tolerances, from which a run can continue; `None`
    /// if nothing was computed.
    pub fn last_state(&self) -> Option<&State<T>> {
        match self {
            Self::Input(_) => None,
            Self::NonFinite { last, .. }
            | Self::StepTooSmall { last, .. }
            | Self::NotSolved { last, .. }
            | Self::NotProjected { last, .. }
            | Self::Event { last, .. }
            | Self::StepLimit { last, .. } => Some(last),
        }
    }

    /// Returns the report of the run until it failed; `None` if nothing was computed.
    pub fn report(&self) -> Option<&Report<T>> {
        match self {
            Self::Input(_) => None,
            Self::NonFinite { report, .. }
            | Self::StepTooSmall { report, .. }
            | Self::NotSolved { report, .. }
            | Self::NotProjected { report, .. }
            | Self::Event { report, .. }
            | Self::StepLimit { report, .. } => Some(report),
        }
    }
}

impl<T> From<InputError<T>> for IntegrationError<T> {
    fn from(error: InputError<T>) -> Self {
        Self::Input(error)
    }
}

impl<T: Real> fmt::Display for IntegrationError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::NonFinite {
                time,
                values,
                last,
                report: _,
            } => write!(
                f,
                "state or rates are not finite at t = {time}, y = {}; \
                 last good state at t = {}",
                FirstNumbers(values),
                last.time
            ),
            Self::StepTooSmall {
                step,
                shortest,
                last,
                report: _,
            } => write!(
                f,
                "a step of {step} at t = {} is below the shortest allowed, {shortest}",
                last.time
            ),
            Self::NotSolved {
                step,
                iterations,
                change,
                last,
                report: _,
            } => write!(
                f,
                "a step of {step} at t = {} is not solved after {iterations} iterations: \
                 the last changed it by {change} of its size",
                last.time
            ),
            Self::NotProjected {
                step,
                iterations,
                deviation,
                last,
                report: _,
            } => write!(
                f,
                "the end of a step of {step} at t = {} is off the level of its first integral \
                 by {deviation} after {iterations} iterations",
                last.time
            ),
            Self::Event {
                event,
                time,
                last: _,
                report: _,
            } => write!(f, "the function of event {event} is NaN at t = {time}"),
            Self::StepLimit {
                limit,
                last,
                report: _,
            } => {
                write!(
                    f,
                    "the limit of {limit} steps was reached at t = {}",
                    last.time
                )
            }
        }
    }
}

/// There is no `source`: the message of [`Input`](IntegrationError::Input) includes the cause.
impl<T: Real> Error for IntegrationError<T> {}

/// Error of a run whose observer can fail.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RunError<T, E> {
    /// The integration failed.
    Integration(IntegrationError<T>),
    /// The observer failed.
    Observer {
        /// Error that the observer returned.
        error: E,
        /// State that was passed to the observer, from which a run can continue.
        last: State<T>,
        /// Report of the run so far.
        report: Report<T>,
    },
}

impl<T, E> From<IntegrationError<T>> for RunError<T, E> {
    fn from(error: IntegrationError<T>) -> Self {
        Self::Integration(error)
    }
}

impl<T> From<RunError<T, Infallible>> for IntegrationError<T> {
    fn from(error: RunError<T, Infallible>) -> Self {
        match error {
            RunError::Integration(error) => error,
            RunError::Observer { error, .. } => match error {},
        }
    }
}

impl<T: Real, E: fmt::Display> fmt::Display for RunError<T, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integration(error) => error.fmt(f),
            Self::Observer { error, .. } => error.fmt(f),
        }
    }
}

/// Displays the message of the inner error.
impl<T: Real, E: Error> Error for RunError<T, E> {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            Self::Observer { error, .. } => error.source(),
        }
    }
}

/// Displays the first numbers of a state and their total count, because the state of a large tree
/// has a million numbers.
pub(super) struct FirstNumbers<'a, T>(pub(super) &'a [T]);

/// Largest number of components that a message shows.
const SHOWN: usize = 6;

impl<T: Real> fmt::Display for FirstNumbers<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(first) = self.0.get(..SHOWN).filter(|_| self.0.len() > SHOWN + 1) else {
            return write!(f, "{:?}", self.0);
        };
        write!(f, "[")?;
        for number in first {
            write!(f, "{number:?}, ")?;
        }
        write!(f, "… ({} components)]", self.0.len())
    }
}
