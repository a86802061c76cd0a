//! Steps of explicit formulas, which need no more than rates at some states.

// A sealed trait names the types.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::grid::FixedStep;
use super::projected::Corrected;
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::piece::{Form, Piece};
use crate::integrate::steps::Failure;
use crate::scalar::Real;
use crate::system::Ode;

/// An explicit formula for a step.
pub trait ExplicitFormula<T: Real, O: ?Sized>: Sized {
    /// Form of the values inside the step.
    const FORM: Form;

    /// Writes the state at the end of a step from `time`, and the rates there.
    fn make(
        step: &mut ExplicitStep<Self, T>,
        system: &mut Evaluator<'_, T, O>,
        time: T,
    ) -> Result<(), Failure<T>>;
}

/// The vectors that a step works on.
#[derive(Clone, Debug)]
pub struct ExplicitStep<F, T> {
    pub(super) start: Vec<T>,
    pub(super) end: Vec<T>,
    /// State at which rates are evaluated, and these.
    pub(super) stage: Vec<T>,
    pub(super) rates: Vec<T>,
    pub(super) start_rates: Vec<T>,
    pub(super) end_rates: Vec<T>,
    /// Length of the step, with its sign.
    pub(super) step: T,
    formula: PhantomData<F>,
}

impl<F, T: Real> ExplicitStep<F, T> {
    pub(super) fn new(start: &[T]) -> Self {
        let zeros = || vec![T::ZERO; start.len()];
        Self {
            start: start.to_vec(),
            end: zeros(),
            stage: zeros(),
            rates: zeros(),
            start_rates: zeros(),
            end_rates: zeros(),
            step: T::ZERO,
            formula: PhantomData,
        }
    }
}

impl<F: ExplicitFormula<T, O>, T: Real, O: Ode<T> + ?Sized> FixedStep<T, O> for ExplicitStep<F, T> {
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        system.evaluate(time, &self.start, &mut self.start_rates)
    }

    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.step = step;
        F::make(self, system, time)
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: F::FORM,
            start: &self.start,
            end: &self.end,
            terms: match F::FORM {
                Form::Linear => [&[]; 2],
                _ => [&self.start_rates, &self.end_rates],
            },
            length: self.step,
        }
    }

    fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_rates, &mut self.end_rates);
    }

    fn set_start(&mut self, values: &[T]) {
        self.start.copy_from_slice(values);
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.numbers(&mut self.start_rates);
    }
}

impl<F: ExplicitFormula<T, O>, T: Real, O: Ode<T> + ?Sized> Corrected<T, O> for ExplicitStep<F, T> {
    fn correct(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        correction: &[T],
    ) -> Result<(), Failure<T>> {
        for (end, &correction) in self.end.iter_mut().zip(correction) {
            *end += correction;
        }
        Ok(system.evaluate(time, &self.end, &mut self.end_rates)?)
    }
}
