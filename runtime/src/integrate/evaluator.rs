//! Evaluation of right-hand sides, with counts of the evaluations and checks of the results.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use alloc::vec::Vec;

use super::report::Report;
use super::request::all_finite;
use super::right_hand_side::RightHandSide;
use crate::scalar::Real;
use crate::system::{Ode, Workspace};

/// A system during a run: its equations, their workspace, and the report of the run.
#[derive(Debug)]
pub struct Evaluator<'r, T, O: ?Sized> {
    pub(crate) ode: &'r O,
    pub(crate) dimension: usize,
    pub(crate) workspace: &'r mut Workspace<T>,
    pub(crate) report: &'r mut Report<T>,
}

impl<T: Real, O: Ode<T> + ?Sized> Evaluator<'_, T, O> {
    /// Writes the rates of change of `state`, without checking that they are finite.
    #[inline(always)]
    pub(crate) fn write(&mut self, time: T, state: &[T], rates: &mut [T]) {
        self.report.evaluations += 1;
        self.ode.rates_with(self.workspace, time, state, rates);
    }

    /// Writes the rates of change of `state` at `time`.
    ///
    /// # Errors
    /// Returns the time and the state if a rate is infinite or NaN.
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

/// Time and state at which the state or its rates are infinite or NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct NonFinite<T> {
    /// Time of the evaluation.
    pub(crate) time: T,
    /// State of the evaluation.
    pub(crate) values: Vec<T>,
}

impl<T: Real> NonFinite<T> {
    /// Creates the record of `time` and `values`.
    #[cold]
    pub(crate) fn new(time: T, values: &[T]) -> Self {
        let values = values.to_vec();
        Self { time, values }
    }
}
