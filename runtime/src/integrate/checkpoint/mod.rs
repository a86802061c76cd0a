//! Checkpoints of motions: data from which a run continues with the same bits.

// The types are public because a sealed trait mentions them; users cannot reach this module.
#![allow(unreachable_pub)]

#[cfg(feature = "serde")]
mod read;

use alloc::vec::Vec;

use super::report::Report;
use crate::scalar::Real;
use crate::system::State;

/// Data from which a [`Stepper`](super::Stepper) continues with the same bits, in this process or
/// another. [`Stepper::checkpoint`](super::Stepper::checkpoint) creates a checkpoint, and
/// [`Integrator::resume`](super::Integrator::resume) continues from it.
///
/// It contains the state, the report, and the memory of the method: length and error of the last
/// step, rounding errors of compensated sums, positions on the grid of fixed steps, and the rates
/// that implicit methods extrapolate. The caller must supply the equations and the method, with its
/// options, again.
///
/// With the feature `serde` a checkpoint can be serialised. The format must keep the bits of its
/// numbers. Deserialised data are checked first: the error names the invalid field.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "read::Unchecked<T>",
        bound(deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct Checkpoint<T> {
    /// Time to which the caller has advanced the motion, and the accumulated rounding error of this
    /// sum.
    pub(super) time: T,
    pub(super) residue: T,
    /// State at the end of the last step.
    pub(super) reached: State<T>,
    /// Direction of the run: 1 forwards, −1 backwards in time.
    pub(super) direction: T,
    pub(super) report: Report<T>,
    pub(super) memory: Vec<T>,
}

impl<T: Real> Checkpoint<T> {
    /// Returns the time of the state.
    pub fn time(&self) -> T {
        self.time
    }

    /// Returns the state that the run has reached.
    pub fn state(&self) -> &[T] {
        &self.reached.values
    }

    /// Returns the report of all steps so far.
    pub fn report(&self) -> &Report<T> {
        &self.report
    }
}

/// Numbers that a method remembers from step to step, in addition to its state. The same function
/// of the method enumerates them for saving and for restoring.
#[derive(Debug)]
pub struct Memory<T> {
    numbers: Vec<T>,
    /// How many numbers have been restored so far; `None` while numbers are being saved.
    restored: Option<usize>,
}

impl<T: Real> Memory<T> {
    /// Creates an empty memory, for saving.
    pub(super) fn new() -> Self {
        Self {
            numbers: Vec::new(),
            restored: None,
        }
    }

    /// Creates a memory from which the given numbers are restored.
    pub(super) fn of(numbers: &[T]) -> Self {
        Self {
            numbers: numbers.to_vec(),
            restored: Some(0),
        }
    }

    /// Returns the saved numbers.
    pub(super) fn into_numbers(self) -> Vec<T> {
        self.numbers
    }

    /// Returns the number of numbers in the memory, and how many the method has requested.
    pub(super) fn counts(&self) -> (usize, usize) {
        let found = self.numbers.len();
        (found, self.restored.unwrap_or(found))
    }

    /// Saves or restores one number.
    pub(super) fn number(&mut self, value: &mut T) {
        match &mut self.restored {
            None => self.numbers.push(*value),
            Some(place) => {
                if let Some(saved) = self.numbers.get(*place) {
                    *value = *saved;
                }
                *place += 1;
            }
        }
    }

    /// Saves or restores all numbers of a slice.
    pub(super) fn numbers(&mut self, values: &mut [T]) {
        for value in values {
            self.number(value);
        }
    }

    /// Saves or restores a number that may be absent.
    pub(super) fn optional(&mut self, value: &mut Option<T>) {
        let (mut is_there, mut number) = (value.is_some(), value.unwrap_or(T::ZERO));
        self.flag(&mut is_there);
        self.number(&mut number);
        *value = is_there.then_some(number);
    }

    /// Saves or restores a flag.
    pub(super) fn flag(&mut self, value: &mut bool) {
        let mut number = if *value { T::ONE } else { T::ZERO };
        self.number(&mut number);
        *value = number != T::ZERO;
    }

    /// Saves or restores an integer. If a restored value is above `largest`, as in a damaged file,
    /// the checkpoint becomes invalid.
    pub(super) fn count(&mut self, value: &mut usize, largest: usize) {
        let mut number = T::from_f64(*value as f64);
        self.number(&mut number);
        *value = (number.to_f64() as usize).min(largest);
    }
}
