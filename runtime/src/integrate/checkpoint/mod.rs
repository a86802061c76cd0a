//! Motions that are laid down and taken up again.

// A sealed trait names the type.
#![allow(unreachable_pub)]

#[cfg(feature = "serde")]
mod read;

use alloc::vec::Vec;

use super::report::Report;
use crate::scalar::Real;
use crate::system::State;

/// All that a [`Stepper`](super::Stepper) needs to go on with the same bits, in this
/// process or another: [`Stepper::checkpoint`](super::Stepper::checkpoint) makes it,
/// [`Integrator::resume`](super::Integrator::resume) takes it.
///
/// It holds the state, the account, and what the method remembers: length and error of
/// the last step, rounding errors that compensated sums carry along, places on the grid of
/// fixed steps, the rates that implicit methods extrapolate. The equations and the method,
/// with its options, are the caller's to bring again.
///
/// With the feature `serde` it is data of serde. A format must keep the bits of its
/// numbers. What is read is checked first: an error names the field that is none of a motion.
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
    /// Time that the caller has reached, and what its rounding left over.
    pub(super) time: T,
    pub(super) residue: T,
    /// The end of the last step.
    pub(super) reached: State<T>,
    /// 1, or −1 backwards.
    pub(super) direction: T,
    pub(super) report: Report<T>,
    pub(super) memory: Vec<T>,
}

impl<T: Real> Checkpoint<T> {
    /// Time of the state.
    pub fn time(&self) -> T {
        self.time
    }

    /// The state.
    pub fn state(&self) -> &[T] {
        &self.reached.values
    }

    /// The account of all steps so far.
    pub fn report(&self) -> &Report<T> {
        &self.report
    }
}

/// The memory of a method beside its state. A method names each number of it once,
/// in one function that both saves and restores.
#[derive(Debug)]
pub struct Memory<T> {
    numbers: Vec<T>,
    /// Number of those that are restored; none while they are saved.
    restored: Option<usize>,
}

impl<T: Real> Memory<T> {
    /// An empty one, to save to.
    pub(super) fn new() -> Self {
        Self {
            numbers: Vec::new(),
            restored: None,
        }
    }

    /// One to restore from.
    pub(super) fn of(numbers: &[T]) -> Self {
        Self {
            numbers: numbers.to_vec(),
            restored: Some(0),
        }
    }

    /// The numbers saved.
    pub(super) fn into_numbers(self) -> Vec<T> {
        self.numbers
    }

    /// Number of numbers that there are, and of those that were asked for.
    pub(super) fn counts(&self) -> (usize, usize) {
        let found = self.numbers.len();
        (found, self.restored.unwrap_or(found))
    }

    /// A number.
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

    /// As many numbers as there are.
    pub(super) fn numbers(&mut self, values: &mut [T]) {
        for value in values {
            self.number(value);
        }
    }

    /// A number that there may be.
    pub(super) fn optional(&mut self, value: &mut Option<T>) {
        let (mut is_there, mut number) = (value.is_some(), value.unwrap_or(T::ZERO));
        self.flag(&mut is_there);
        self.number(&mut number);
        *value = is_there.then_some(number);
    }

    /// A truth.
    pub(super) fn flag(&mut self, value: &mut bool) {
        let mut number = if *value { T::ONE } else { T::ZERO };
        self.number(&mut number);
        *value = number != T::ZERO;
    }

    /// A whole number, at most `largest`, which files that lie do not exceed.
    pub(super) fn count(&mut self, value: &mut usize, largest: usize) {
        let mut number = T::from_f64(*value as f64);
        self.number(&mut number);
        *value = (number.to_f64() as usize).min(largest);
    }
}
