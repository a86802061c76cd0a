//! Checks of what is to be integrated, shared by all methods.

use super::error::{InputError, IntegrationError};
use super::options::Options;
use super::report::{Report, StopReason};
use crate::scalar::Real;
use crate::system::{Ode, State};

/// The start fits the equations and is finite.
pub(crate) fn check_start<T: Real, O: Ode<T> + ?Sized>(
    ode: &O,
    start: &State<T>,
) -> Result<(), InputError<T>> {
    let (expected, found) = (ode.dimension(), start.values.len());
    if expected != found {
        return Err(InputError::Dimension { expected, found });
    }
    if found == 0 {
        return Err(InputError::EmptyState);
    }
    if !start.time.is_finite() {
        return Err(InputError::StartTime { value: start.time });
    }
    if let Some((component, &value)) = start
        .values
        .iter()
        .enumerate()
        .find(|(_, value)| !value.is_finite())
    {
        return Err(InputError::StartValue { component, value });
    }
    Ok(())
}

/// The times are finite and run one way from `start`; equal ones may follow
/// each other.
pub(crate) fn check_times<T: Real>(start: T, times: &[T]) -> Result<(), InputError<T>> {
    let mut previous = start;
    let (mut forwards, mut backwards) = (false, false);
    for (index, &value) in times.iter().enumerate() {
        if !value.is_finite() {
            return Err(InputError::Time { index, value });
        }
        forwards |= value > previous;
        backwards |= value < previous;
        if forwards && backwards {
            return Err(InputError::TimeOrder {
                index,
                previous,
                value,
            });
        }
        previous = value;
    }
    Ok(())
}

/// True if all values are finite; without a branch for each.
#[inline]
pub(crate) fn all_finite<T: Real>(values: &[T]) -> bool {
    values
        .iter()
        .fold(true, |finite, value| finite & value.is_finite())
}

/// Checks that a run with this account may try a step from `time` of length `step`;
/// `last` if it reaches the end. `state` is the last accepted one.
pub(crate) fn check_step<T: Real>(
    options: &Options<T>,
    report: &Report<T>,
    (time, step, last): (T, T, bool),
    state: impl FnOnce() -> State<T>,
) -> Result<(), IntegrationError<T>> {
    let limit = options.step_limit;
    if report.accepted + report.rejected >= limit {
        return Err(IntegrationError::StepLimit {
            limit,
            last: state(),
            report: Report {
                stop: StopReason::StepLimit,
                ..*report
            },
        });
    }
    // Below this, time plus step is mostly rounding.
    let lost = T::from_f64(10.0) * T::EPSILON * time.abs();
    // The end may be as near as it likes.
    if !last && (step < options.min_step || step <= lost) {
        return Err(IntegrationError::StepTooSmall {
            step,
            shortest: options.min_step.max(lost),
            last: state(),
            report: Report {
                stop: StopReason::StepTooSmall,
                ..*report
            },
        });
    }
    Ok(())
}
