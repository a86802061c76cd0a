//! Evaluations of a right-hand side.

use alloc::vec::Vec;

use super::error::IntegrationError;
use super::report::{Report, StopReason};
use super::request::all_finite;
use crate::scalar::Real;
use crate::system::{Ode, State, Workspace};

/// A system, with the memory that its evaluations need.
pub(crate) struct Evaluator<'a, T, O: ?Sized> {
    ode: &'a O,
    dimension: usize,
    /// Number of evaluations so far.
    pub(crate) evaluations: u64,
    workspace: Workspace<T>,
}

impl<'a, T: Real, O: Ode<T> + ?Sized> Evaluator<'a, T, O> {
    /// Evaluates `ode` for states of `dimension` components.
    pub(crate) fn new(ode: &'a O, dimension: usize) -> Self {
        Self {
            ode,
            dimension,
            evaluations: 0,
            workspace: Workspace::new(),
        }
    }

    /// Number of components of a state.
    #[inline(always)]
    pub(crate) fn dimension(&self) -> usize {
        self.dimension
    }

    /// Writes the rates of `state`, finite or not.
    #[inline(always)]
    pub(crate) fn write(&mut self, time: T, state: &[T], rates: &mut [T]) {
        self.evaluations += 1;
        self.ode.rates_with(&mut self.workspace, time, state, rates);
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

/// A place where state or rates are not finite.
#[derive(Clone, Debug, PartialEq)]
#[allow(unreachable_pub)]
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

    /// The error of a run that ends here; `last` is its last good state.
    #[cold]
    pub(crate) fn error(self, last: State<T>, report: Report<T>) -> IntegrationError<T> {
        IntegrationError::NonFinite {
            time: self.time,
            values: self.values,
            last,
            report: Report {
                stop: StopReason::NonFinite,
                ..report
            },
        }
    }
}
