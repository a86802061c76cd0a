//! The vectors that a step works on, and what is done with them.

// A sealed trait names the type.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;

use super::{Gauss, Solver};
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::fixed::grid::{Corrected, FixedStep};
use crate::integrate::fixed::linear::Factored;
use crate::integrate::piece::{Form, GaussOrder, GaussTable, Piece};
use crate::integrate::request::all_finite;
use crate::integrate::steps::Failure;
use crate::scalar::Real;
use crate::scalar::two_sum;
use crate::system::Ode;

/// A Gauss method at work.
#[derive(Clone, Debug)]
pub struct GaussStep<T> {
    order: GaussOrder,
    pub(super) table: &'static GaussTable,
    pub(super) solver: Solver,
    pub(super) tolerance: T,
    pub(super) iteration_limit: u32,
    pub(super) start: Vec<T>,
    end: Vec<T>,
    /// Rounding error of `start`, to be added to it.
    pub(super) residue: Vec<T>,
    end_residue: Vec<T>,
    /// Largest size of each component so far: what its changes are measured
    /// by, since one that passes through zero has no size of its own.
    pub(super) sizes: Vec<T>,
    /// Rates of the stages, one after the other.
    pub(super) rates: Vec<T>,
    /// Increments of the stages over the start, one after the other.
    pub(super) increments: Vec<T>,
    /// Change of the rates in an iteration.
    pub(super) change: Vec<T>,
    /// State at which rates are evaluated.
    pub(super) stage: Vec<T>,
    /// Rates at the start of the run, or at a point of a difference.
    pub(super) other: Vec<T>,
    /// Step that `rates` belong to: zero before the first, and after a failed
    /// one, when there is nothing to extrapolate.
    pub(super) step: T,
    /// Matrix of Newton's method and the step that it was made for.
    pub(super) newton: Factored<T>,
    pub(super) newton_step: T,
    /// Derivatives of the rates, row after row.
    pub(super) derivatives: Vec<T>,
}

impl<T: Real> GaussStep<T> {
    pub(in crate::integrate::fixed) fn new(method: &Gauss<T>, start: &[T]) -> Self {
        let table = method.order.table();
        let (n, s) = (start.len(), table.nodes.len());
        let matrix = match method.solver {
            Solver::FixedPoint => 0,
            Solver::Newton => n,
        };
        Self {
            order: method.order,
            table,
            solver: method.solver,
            tolerance: method.tolerance,
            iteration_limit: method.iteration_limit,
            start: start.to_vec(),
            end: vec![T::ZERO; n],
            residue: vec![T::ZERO; n],
            end_residue: vec![T::ZERO; n],
            sizes: start.iter().map(|value| value.abs()).collect(),
            rates: vec![T::ZERO; n * s],
            increments: vec![T::ZERO; n * s],
            change: vec![T::ZERO; n * s],
            stage: vec![T::ZERO; n],
            other: vec![T::ZERO; n],
            step: T::ZERO,
            newton: Factored::new(matrix * s),
            newton_step: T::ZERO,
            derivatives: vec![T::ZERO; matrix * matrix],
        }
    }

    /// Increments of the stages from the polynomial of the step before, or
    /// along the rates at the start where there is none.
    fn guess(&mut self, step: T) {
        let (n, s) = (self.start.len(), self.table.nodes.len());
        let ratio = if self.step == T::ZERO {
            T::ZERO
        } else {
            step / self.step
        };
        for (i, &node) in self.table.nodes.iter().enumerate() {
            let own = &mut self.increments[i * n..(i + 1) * n];
            if self.step == T::ZERO {
                let part = T::from_f64(node) * step;
                for (value, &rate) in own.iter_mut().zip(&self.other) {
                    *value = part * rate;
                }
                continue;
            }
            own.fill(T::ZERO);
            let place = T::ONE + ratio * T::from_f64(node);
            for j in 0..s {
                let weight =
                    self.step * (self.order.integral(j, place) - self.order.integral(j, T::ONE));
                for (value, &rate) in own.iter_mut().zip(&self.rates[j * n..(j + 1) * n]) {
                    *value += weight * rate;
                }
            }
        }
    }

    /// y at the end of the step, from the rates of the stages.
    fn finish(&mut self, step: T) {
        let n = self.start.len();
        for i in 0..n {
            let (mut main, mut rest) = (T::ZERO, T::ZERO);
            for (j, &(large, small)) in self.table.weights.iter().enumerate() {
                main += T::from_f64(large) * self.rates[j * n + i];
                rest += T::from_f64(small) * self.rates[j * n + i];
            }
            let increment = step * main + (step * rest + self.residue[i]);
            (self.end[i], self.end_residue[i]) = two_sum(self.start[i], increment);
            self.sizes[i] = self.sizes[i].max(self.end[i].abs());
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> FixedStep<T, O> for GaussStep<T> {
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        system.evaluate(time, &self.start, &mut self.other)
    }

    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.guess(step);
        if let Err(failure) = self.solve(system, time, step) {
            // The rates of a failed step say nothing: begin anew.
            self.step = T::ZERO;
            FixedStep::<T, O>::begin(self, system, time)?;
            return Err(failure);
        }
        self.step = step;
        self.finish(step);
        if all_finite(&self.end) {
            return Ok(());
        }
        Err(NonFinite::new(time + step, &self.end).into())
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: Form::Collocation(self.order),
            start: &self.start,
            end: &self.end,
            terms: [&self.rates, &[]],
            length: self.step,
        }
    }

    fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.residue, &mut self.end_residue);
    }

    /// The matrix of Newton's method stays: it decides how fast a step is solved, and
    /// is made anew where it does not serve.
    fn set_start(&mut self, values: &[T]) {
        self.start.copy_from_slice(values);
        self.residue.fill(T::ZERO);
        self.step = T::ZERO;
        for (size, value) in self.sizes.iter_mut().zip(values) {
            *size = size.max(value.abs());
        }
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.numbers(&mut self.residue);
        memory.numbers(&mut self.sizes);
        memory.numbers(&mut self.rates);
        memory.numbers(&mut self.other);
        memory.number(&mut self.step);
        self.newton.remember(memory);
        memory.number(&mut self.newton_step);
    }
}

impl<T: Real, O: Ode<T> + ?Sized> Corrected<T, O> for GaussStep<T> {
    fn correct(
        &mut self,
        _system: &mut Evaluator<'_, T, O>,
        _time: T,
        correction: &[T],
    ) -> Result<(), Failure<T>> {
        let ends = self.end.iter_mut().zip(&mut self.end_residue);
        for ((end, residue), &correction) in ends.zip(correction) {
            (*end, *residue) = two_sum(*end, *residue + correction);
        }
        Ok(())
    }
}
