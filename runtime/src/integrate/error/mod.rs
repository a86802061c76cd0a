//! Why an integration did not run, or did not reach its end.

mod input;

use alloc::vec::Vec;
use core::convert::Infallible;
use core::error::Error;
use core::fmt;

use super::report::Report;
use crate::scalar::Real;
use crate::system::State;

pub use input::InputError;

/// Why an integration ended before its goal.
///
/// Every variant but [`Input`](Self::Input) carries the last state that was
/// reached within the tolerances: a run can be continued from it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntegrationError<T> {
    /// The request cannot be answered; nothing was computed.
    Input(InputError<T>),
    /// The right-hand side, or the state within a step, became infinite or
    /// NaN.
    NonFinite {
        /// Time of the evaluation, in general inside a step.
        time: T,
        /// State at which the rates were evaluated.
        values: Vec<T>,
        /// The last accepted state.
        last: State<T>,
        /// Account of the run so far.
        report: Report<T>,
    },
    /// The tolerances ask for a step below the shortest allowed.
    StepTooSmall {
        /// Length of the step asked for.
        step: T,
        /// Shortest step allowed: the option, or what the rounding of the time
        /// leaves.
        shortest: T,
        /// The last accepted state.
        last: State<T>,
        /// Account of the run so far.
        report: Report<T>,
    },
    /// The equations of an implicit step were not solved, however often it was
    /// halved.
    NotSolved {
        /// Length of the last step tried.
        step: T,
        /// Iterations made for it.
        iterations: u32,
        /// Largest change of a component in the last iteration, relative to its
        /// size; NaN where the matrix of Newton's method is singular.
        change: T,
        /// The last accepted state.
        last: State<T>,
        /// Account of the run so far.
        report: Report<T>,
    },
    /// The end of a step was not brought back to the level of a first integral,
    /// however often the step was halved.
    NotProjected {
        /// Length of the last step tried.
        step: T,
        /// Newton iterations made for its end.
        iterations: u32,
        /// Value of the integral minus its level, after the last iteration.
        deviation: T,
        /// The last accepted state.
        last: State<T>,
        /// Account of the run so far.
        report: Report<T>,
    },
    /// The function of an event is NaN.
    Event {
        /// Index of the event among those asked for.
        event: usize,
        /// Time of the evaluation.
        time: T,
        /// The last accepted state.
        last: State<T>,
        /// Account of the run so far.
        report: Report<T>,
    },
    /// The limit on the number of steps was reached.
    StepLimit {
        /// The limit.
        limit: u64,
        /// The last accepted state.
        last: State<T>,
        /// Account of the run so far.
        report: Report<T>,
    },
}

impl<T> IntegrationError<T> {
    /// The last state reached within the tolerances, to continue from; none
    /// where nothing was computed.
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

    /// The account of the run until it failed; none where nothing was
    /// computed.
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

/// The message tells all: that of [`Input`](IntegrationError::Input) is the fault of the
/// request itself.
impl<T: Real> Error for IntegrationError<T> {}

/// Why a run ended before its goal whose observer may fail.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RunError<T, E> {
    /// The integration failed.
    Integration(IntegrationError<T>),
    /// The observer failed.
    Observer {
        /// Error of the observer.
        error: E,
        /// The state that it saw, to continue from.
        last: State<T>,
        /// Account of the run so far.
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

/// Messages are those of the error within.
impl<T: Real, E: Error> Error for RunError<T, E> {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            Self::Observer { error, .. } => error.source(),
        }
    }
}

/// The numbers of a state in a message, of which a tree has a million: the first ones,
/// and how many there are.
pub(super) struct FirstNumbers<'a, T>(pub(super) &'a [T]);

/// Numbers that a message shows.
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
