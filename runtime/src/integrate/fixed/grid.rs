//! The steps of all methods with steps of a given length.

// A sealed trait names the types.
#![allow(unreachable_pub)]

use crate::integrate::checkpoint::Memory;
use crate::integrate::error::InputError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::piece::Piece;
use crate::integrate::steps::{Failure, Goal, Steps, check_number};
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

/// Length and limits of the steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid<T> {
    /// Length of the steps.
    pub(super) step: T,
    /// Number of times that a step that is not solved may be halved.
    pub(super) halvings: u32,
    /// Number of steps, made and failed together, after which a run ends.
    pub(super) step_limit: u64,
}

impl<T: Real> Grid<T> {
    /// The steps of `method` on this grid.
    pub(super) fn steps<S>(self, method: S) -> Result<GridSteps<S, T>, InputError<T>> {
        if !(self.step.is_finite() && self.step > T::ZERO) {
            return Err(InputError::Step {
                name: "fixed",
                value: self.step,
            });
        }
        Ok(GridSteps {
            method,
            grid: self,
            origin: None,
            number: T::ZERO,
            halved: 0,
            length: self.step,
            left: self.step,
        })
    }
}

/// A method at work with steps on a grid of times.
///
/// The end of step k of the grid is the origin + k step: rounding does not add up over
/// the steps.
#[derive(Clone, Debug)]
pub struct GridSteps<S, T> {
    method: S,
    grid: Grid<T>,
    /// Time from which the grid counts; none before the first step.
    origin: Option<T>,
    /// Places of the grid that have been reached.
    number: T,
    /// Number of times that the step is halved, and its length.
    halved: u32,
    length: T,
    /// Length that is left to the next place of the grid. Steps get this length, not
    /// the difference of two rounded times: lengths that tremble would cost
    /// the symplectic property, in `f32` visibly.
    left: T,
}

impl<S, T: Real> GridSteps<S, T> {
    /// Counts the grid from `time` on.
    fn count_from(&mut self, time: T) {
        self.origin = Some(time);
        (self.number, self.left) = (T::ZERO, self.grid.step);
        (self.halved, self.length) = (0, self.grid.step);
    }
}

impl<S: FixedStep<T, O>, T: Real, O: ?Sized> Steps<T, O> for GridSteps<S, T> {
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>> {
        let Grid {
            step,
            halvings,
            step_limit,
        } = self.grid;
        let origin = self.origin.unwrap_or(time);
        // Below this, time plus step is mostly rounding.
        let farthest = goal.end.unwrap_or(time).abs();
        let lost = T::from_f64(10.0) * T::EPSILON * origin.abs().max(farthest);
        if self.origin.is_none() {
            system.report.next_step = step;
            if step <= lost {
                return Err(Failure::StepTooSmall {
                    step,
                    shortest: lost,
                });
            }
            self.method.begin(system, time)?;
            self.count_from(time);
        }
        loop {
            let place = origin + goal.direction * (self.number + T::ONE) * step;
            // No sliver is left over where rounding misses the end.
            let near = (T::from_f64(1e-9) * step).max(lost);
            let aim = match goal.end {
                Some(end) if (end - place) * goal.direction <= near => end,
                _ => place,
            };
            let short = (aim - place).abs() > near;
            let reach = if short { (aim - time).abs() } else { self.left };
            let reaches = self.halved == 0 || reach - self.length <= near;
            let made = if reaches { reach } else { self.length };
            let end_time = if reaches {
                aim
            } else {
                time + goal.direction * self.length
            };
            check_number(step_limit, system.report, goal.steps_before)?;
            // Times so late that a step is lost in their rounding.
            if end_time == time {
                return Err(Failure::StepTooSmall {
                    step: made,
                    shortest: lost,
                });
            }
            match self.method.make(system, time, goal.direction * made) {
                Ok(()) => {}
                // Rates that are not finite may be those of an iterate far off.
                Err(_) if self.halved < halvings && T::from_f64(0.5) * self.length > lost => {
                    system.report.rejected += 1;
                    self.halved += 1;
                    self.length = T::from_f64(0.5) * self.length;
                    continue;
                }
                Err(failure) => return Err(failure),
            }
            system.report.accept(made);
            if self.halved > 0 {
                self.halved -= 1;
                self.length = self.length + self.length;
            }
            if !reaches {
                self.left = self.left - made;
            } else if short {
                self.count_from(end_time);
            } else {
                self.number += T::ONE;
                self.left = step;
            }
            return Ok(end_time);
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
        self.origin = None;
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.optional(&mut self.origin);
        memory.number(&mut self.number);
        let mut halved = self.halved as usize;
        memory.count(&mut halved, self.grid.halvings as usize);
        self.halved = halved as u32;
        memory.number(&mut self.length);
        memory.number(&mut self.left);
        self.method.remember(memory);
    }
}
