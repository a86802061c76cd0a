//! Checks of the arguments of a run, shared by all methods.

use super::error::InputError;
use crate::scalar::Real;
use crate::system::Ode;

/// Checks that start time and values are finite and fit the equations.
pub(crate) fn check_start<T: Real, O: Ode<T> + ?Sized>(
    ode: &O,
    (time, values): (T, &[T]),
) -> Result<(), InputError<T>> {
    let (expected, found) = (ode.dimension(), values.len());
    if expected != found {
        return Err(InputError::Dimension { expected, found });
    }
    if found == 0 {
        return Err(InputError::EmptyState);
    }
    if !time.is_finite() {
        return Err(InputError::StartTime { value: time });
    }
    if let Some((component, &value)) = values
        .iter()
        .enumerate()
        .find(|(_, value)| !value.is_finite())
    {
        return Err(InputError::StartValue { component, value });
    }
    Ok(())
}

/// Checks that the end time is finite.
pub(crate) fn check_end<T: Real>(end: T) -> Result<(), InputError<T>> {
    match end.is_finite() {
        true => Ok(()),
        false => Err(InputError::EndTime { value: end }),
    }
}

/// Checks that all times are finite, and that they all increase or all decrease from `start`. Equal
/// times may follow each other.
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

/// Returns true if all values are finite. It tests the sum of the values times zero, which needs no
/// branch per value.
#[inline]
pub(crate) fn all_finite<T: Real>(values: &[T]) -> bool {
    let zeros = values.iter().map(|&value| T::ZERO * value);
    zeros.fold(T::ZERO, |sum, zero| sum + zero) == T::ZERO
}
