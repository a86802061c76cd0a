//! The grid of times that steps of a given length go along, for one state or for each lane.

use crate::integrate::checkpoint::Memory;
use crate::integrate::error::InputError;
use crate::integrate::report::Report;
use crate::integrate::steps::{Failure, Goal, check_number};
use crate::scalar::Real;

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
    /// Passes a grid whose steps have a length.
    pub(super) fn check(&self) -> Result<(), InputError<T>> {
        if self.step.is_finite() && self.step > T::ZERO {
            return Ok(());
        }
        Err(InputError::Step {
            name: "fixed",
            value: self.step,
        })
    }

    /// The place of a run on this grid that has not begun.
    pub(super) fn place(self) -> Result<GridPlace<T>, InputError<T>> {
        self.check()?;
        Ok(GridPlace::new(self))
    }
}

/// How far a run has come on its grid of times.
///
/// The end of step k of the grid is the origin + k step: rounding does not add up over
/// the steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct GridPlace<T> {
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

/// A step that is to be tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlannedStep<T> {
    pub(super) length: T,
    pub(super) end_time: T,
    /// True if it ends at a place of the grid, or at the goal.
    reaches: bool,
    /// True if the goal lies before the next place of the grid.
    short: bool,
    /// Below this length, time plus step is mostly rounding.
    lost: T,
}

impl<T: Real> GridPlace<T> {
    /// A run on `grid` that has not begun.
    pub(super) fn new(grid: Grid<T>) -> Self {
        Self {
            grid,
            origin: None,
            number: T::ZERO,
            halved: 0,
            length: grid.step,
            left: grid.step,
        }
    }

    /// The grid.
    pub(super) fn grid(&self) -> Grid<T> {
        self.grid
    }

    /// Returns true before the first step.
    pub(super) fn is_new(&self) -> bool {
        self.origin.is_none()
    }

    /// Below this length, time plus step is mostly rounding.
    #[inline(always)]
    fn lost(&self, time: T, goal: Goal<T>) -> T {
        let origin = self.origin.unwrap_or(time);
        let farthest = goal.end.unwrap_or(time).abs();
        T::from_f64(10.0) * T::EPSILON * origin.abs().max(farthest)
    }

    /// Passes a run from `time` whose steps are not lost in rounding.
    pub(super) fn check_start(&self, time: T, goal: Goal<T>) -> Result<(), Failure<T>> {
        let (step, shortest) = (self.grid.step, self.lost(time, goal));
        if step <= shortest {
            return Err(Failure::StepTooSmall { step, shortest });
        }
        Ok(())
    }

    /// Counts the grid from `time` on.
    #[inline(always)]
    pub(super) fn count_from(&mut self, time: T) {
        *self = Self {
            origin: Some(time),
            ..Self::new(self.grid)
        };
    }

    /// Begins anew with the next step.
    pub(super) fn leave(&mut self) {
        self.origin = None;
    }

    /// Plans the next step, from `time` on.
    #[inline(always)]
    pub(super) fn plan(&self, time: T, goal: Goal<T>) -> PlannedStep<T> {
        let step = self.grid.step;
        let lost = self.lost(time, goal);
        let origin = self.origin.unwrap_or(time);
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
        let halved_end = time + goal.direction * self.length;
        PlannedStep {
            length: if reaches { reach } else { self.length },
            end_time: if reaches { aim } else { halved_end },
            reaches,
            short,
            lost,
        }
    }

    /// Passes a planned step in a run with this account, from `time` on.
    #[inline(always)]
    pub(super) fn check(
        &self,
        planned: PlannedStep<T>,
        time: T,
        report: &Report<T>,
        steps_before: u64,
    ) -> Result<(), Failure<T>> {
        check_number(self.grid.step_limit, report, steps_before)?;
        // Times so late that a step is lost in their rounding.
        if planned.end_time == time {
            return Err(Failure::StepTooSmall {
                step: planned.length,
                shortest: planned.lost,
            });
        }
        Ok(())
    }

    /// Halves the step after one that was not solved. Returns false if it may not be.
    pub(super) fn halve(&mut self, planned: PlannedStep<T>) -> bool {
        let half = T::from_f64(0.5) * self.length;
        let may = self.halved < self.grid.halvings && half > planned.lost;
        if may {
            self.halved += 1;
            self.length = half;
        }
        may
    }

    /// Moves to the end of a step that was made.
    #[inline(always)]
    pub(super) fn reach(&mut self, planned: PlannedStep<T>) {
        if self.halved > 0 {
            self.halved -= 1;
            self.length = self.length + self.length;
        }
        if !planned.reaches {
            self.left = self.left - planned.length;
        } else if planned.short {
            self.count_from(planned.end_time);
        } else {
            self.number += T::ONE;
            self.left = self.grid.step;
        }
    }

    /// Saves or restores the place.
    pub(super) fn remember(&mut self, memory: &mut Memory<T>) {
        memory.optional(&mut self.origin);
        memory.number(&mut self.number);
        let mut halved = self.halved as usize;
        memory.count(&mut halved, self.grid.halvings as usize);
        self.halved = halved as u32;
        memory.number(&mut self.length);
        memory.number(&mut self.left);
    }
}
