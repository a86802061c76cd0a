//! Evaluations of a right-hand side.

// A sealed trait names the types.
#![allow(unreachable_pub)]

use alloc::vec::Vec;

use super::report::Report;
use super::request::all_finite;
use super::right_hand_side::RightHandSide;
use crate::scalar::Real;
use crate::system::{Ode, Workspace};

/// A system under way: its equations, the memory that they need, and the account of
/// its run.
#[derive(Debug)]
pub struct Evaluator<'r, T, O: ?Sized> {
    pub(crate) ode: &'r O,
    pub(crate) dimension: usize,
    pub(crate) workspace: &'r mut Workspace<T>,
    pub(crate) report: &'r mut Report<T>,
}

impl<T: Real, O: Ode<T> + ?Sized> Evaluator<'_, T, O> {
    /// Writes the rates of `state`, finite or not.
    #[inline(always)]
    pub(crate) fn write(&mut self, time: T, state: &[T], rates: &mut [T]) {
        self.report.evaluations += 1;
        self.ode.rates_with(self.workspace, time, state, rates);
    }

    /// Writes the rates of `state`.
    ///
    /// # Errors
    /// Gives time and state back where the rates are not finite.
    #[inline(always)]
    pub(crate) fn evaluate(
        &mut self,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) -> Result<(), NonFinite<T>> {
        self.write(time, state, rates);
        if all_finite(rates) {
            Ok(())
        } else {
            Err(NonFinite::new(time, state))
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> RightHandSide<T> for Evaluator<'_, T, O> {
    type Failure = NonFinite<T>;

    #[inline(always)]
    fn dimension(&self) -> usize {
        self.dimension
    }

    #[inline(always)]
    fn write(&mut self, time: T, state: &[T], rates: &mut [T]) {
        self.write(time, state, rates);
    }

    #[inline(always)]
    fn evaluate(
        &mut self,
        _stage: usize,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) -> Result<(), NonFinite<T>> {
        self.evaluate(time, state, rates)
    }
}

/// A place where state or rates are not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct NonFinite<T> {
    /// Time of the evaluation.
    pub(crate) time: T,
    /// State of the evaluation.
    pub(crate) values: Vec<T>,
}

impl<T: Real> NonFinite<T> {
    /// The place at `time` with the state `values`.
    #[cold]
    pub(crate) fn new(time: T, values: &[T]) -> Self {
        let values = values.to_vec();
        Self { time, values }
    }
}
