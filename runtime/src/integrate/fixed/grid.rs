//! The steps of all methods with steps of a given length.

// A sealed trait names the types.
#![allow(unreachable_pub)]

use super::place::GridPlace;
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::piece::Piece;
use crate::integrate::steps::{Failure, Goal, Steps};
use crate::scalar::Real;

/// How a method makes a step of a given length, and the memory that it takes.
pub trait FixedStep<T: Real, O: ?Sized> {
    /// Evaluates what the first step needs; `time` is that of the start.
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>>;

    /// Makes a step of length `step` (negative: backwards) from `time`.
    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>>;

    /// The step and its polynomial.
    fn piece(&self) -> Piece<'_, T>;

    /// Makes the end of the step the start of the next.
    fn advance(&mut self);

    /// Takes these values for the start of the next step.
    fn set_start(&mut self, values: &[T]);

    /// Saves what the next step depends on, beside the state at its start, or restores
    /// it.
    fn remember(&mut self, memory: &mut Memory<T>);
}

/// A method whose end of a step may be moved.
pub trait Corrected<T: Real, O: ?Sized>: FixedStep<T, O> {
    /// Adds `correction` to the end of the step, at the time `time`.
    fn correct(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        correction: &[T],
    ) -> Result<(), Failure<T>>;
}

/// A method at work with steps on a grid of times.
#[derive(Clone, Debug)]
pub struct GridSteps<S, T> {
    method: S,
    place: GridPlace<T>,
}

impl<S, T: Real> GridSteps<S, T> {
    /// The steps of `method` on the grid of `place`.
    pub(super) fn new(method: S, place: GridPlace<T>) -> Self {
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
                // Rates that are not finite may be those of an iterate far off.
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
