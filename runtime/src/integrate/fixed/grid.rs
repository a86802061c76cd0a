//! Integration of a single trajectory by methods with steps of constant length.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use super::grid_position::GridPosition;
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::piece::Piece;
use crate::integrate::steps::{Failure, Goal, Steps};
use crate::scalar::Real;

/// Method that makes steps of a given length, with its data during a run.
pub trait FixedStep<T: Real, O: ?Sized> {
    /// Evaluates the rates that the first step needs; `time` is the start time.
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>>;

    /// Makes a step of length `step` (negative: backwards) from `time`.
    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>>;

    /// Returns the last step and its polynomial.
    fn piece(&self) -> Piece<'_, T>;

    /// Makes the end of the step the start of the next step.
    fn advance(&mut self);

    /// Sets the start of the next step.
    fn set_start(&mut self, values: &[T]);

    /// Saves or restores the numbers on which the next step depends, in addition to the state at
    /// its start.
    fn remember(&mut self, memory: &mut Memory<T>);
}

/// Method that allows the state at the end of a step to be corrected.
pub trait Corrected<T: Real, O: ?Sized>: FixedStep<T, O> {
    /// Adds `correction` to the state at the end of the step; `time` is the time there.
    fn correct(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        correction: &[T],
    ) -> Result<(), Failure<T>>;
}

/// Data of a method that makes steps of constant length along a grid of times.
#[derive(Clone, Debug)]
pub struct GridSteps<S, T> {
    method: S,
    place: GridPosition<T>,
}

impl<S, T: Real> GridSteps<S, T> {
    /// Creates the integrator from a method and its position on the grid of times.
    pub(super) fn new(method: S, place: GridPosition<T>) -> Self {
        Self { method, place }
    }
}

impl<S: FixedStep<T, O>, T: Real, O: ?Sized> Steps<T, O> for GridSteps<S, T> {
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>> {
        if self.place.is_new() {
            system.report.next_step = self.place.grid().step;
            self.place.check_start(time, goal)?;
            self.method.begin(system, time)?;
            self.place.count_from(time);
        }
        loop {
            let planned = self.place.plan(time, goal);
            self.place
                .check(planned, time, system.report, goal.steps_before)?;
            let step = goal.direction * planned.length;
            match self.method.make(system, time, step) {
                Ok(()) => {}
                // Rates that are not finite may come from an iterate far from the solution.
                Err(_) if self.place.halve(planned) => {
                    system.report.rejected += 1;
                    continue;
                }
                Err(failure) => return Err(failure),
            }
            system.report.accept(planned.length);
            self.place.reach(planned);
            return Ok(planned.end_time);
        }
    }

    fn piece(&self) -> Piece<'_, T> {
        self.method.piece()
    }

    fn advance(&mut self) {
        self.method.advance();
    }

    fn restart(&mut self, values: &[T]) {
        self.method.set_start(values);
        self.place.leave();
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        self.place.remember(memory);
        self.method.remember(memory);
    }
}
