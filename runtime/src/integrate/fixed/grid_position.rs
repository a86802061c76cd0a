//! Times of the steps of a run with a constant step length, for a single state or for each lane.

use crate::integrate::checkpoint::Memory;
use crate::integrate::error::InputError;
use crate::integrate::report::Report;
use crate::integrate::steps::{Failure, Goal, check_number};
use crate::scalar::Real;

/// Length and limits of the steps of a run with a constant step length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid<T> {
    /// Length of the steps.
    pub(super) step: T,
    /// Number of times that a step may be halved if its equations cannot be solved.
    pub(super) halvings: u32,
    /// Number of steps, completed and failed, after which a run ends.
    pub(super) step_limit: u64,
}

impl<T: Real> Grid<T> {
    /// Checks that the step length is positive and finite.
    pub(super) fn check(&self) -> Result<(), InputError<T>> {
        if self.step.is_finite() && self.step > T::ZERO {
            return Ok(());
        }
        Err(InputError::Step {
            name: "fixed",
            value: self.step,
        })
    }

    /// Returns the position on this grid of a run before its first step.
    pub(super) fn place(self) -> Result<GridPosition<T>, InputError<T>> {
        self.check()?;
        Ok(GridPosition::new(self))
    }
}

/// Position of a run on its grid of times with constant spacing.
///
/// Step k of the grid ends at origin + k · step, so that rounding does not add up over the steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct GridPosition<T> {
    grid: Grid<T>,
    /// Time from which grid times are counted; `None` before the first step.
    origin: Option<T>,
    /// Number of grid times that the run has reached.
    number: T,
    /// Number of times that the step has been halved, and the length of the halved step.
    halved: u32,
    length: T,
    /// Remaining length to the next grid time. Steps use this length and not the difference of two
    /// rounded times: fluctuating lengths would destroy the symplectic property, visibly in `f32`.
    left: T,
}

/// A step to be tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlannedStep<T> {
    pub(super) length: T,
    pub(super) end_time: T,
    /// True if the step ends at a grid time or at the end of the run.
    reaches: bool,
    /// True if the end of the run lies before the next grid time.
    short: bool,
    /// Length below which time + step is dominated by the rounding of the time.
    lost: T,
}

impl<T: Real> GridPosition<T> {
    /// Creates the position of a run on `grid` before its first step.
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

    /// Returns the length and limits of the steps.
    pub(super) fn grid(&self) -> Grid<T> {
        self.grid
    }

    /// Returns true before the first step.
    pub(super) fn is_new(&self) -> bool {
        self.origin.is_none()
    }

    /// Returns the length below which time + step is dominated by the rounding of the time.
    #[inline(always)]
    fn lost(&self, time: T, goal: Goal<T>) -> T {
        let origin = self.origin.unwrap_or(time);
        let farthest = goal.end.unwrap_or(time).abs();
        T::from_f64(10.0) * T::EPSILON * origin.abs().max(farthest)
    }

    /// Checks, for a run that starts at `time`, that steps are longer than the rounding of the
    /// time.
    pub(super) fn check_start(&self, time: T, goal: Goal<T>) -> Result<(), Failure<T>> {
        let (step, shortest) = (self.grid.step, self.lost(time, goal));
        if step <= shortest {
            return Err(Failure::StepTooSmall { step, shortest });
        }
        Ok(())
    }

    /// Sets the origin of the grid to `time`.
    #[inline(always)]
    pub(super) fn count_from(&mut self, time: T) {
        *self = Self {
            origin: Some(time),
            ..Self::new(self.grid)
        };
    }

    /// Discards the grid, so that the next step starts a new one.
    pub(super) fn leave(&mut self) {
        self.origin = None;
    }

    /// Plans the next step, which starts at `time`.
    #[inline(always)]
    pub(super) fn plan(&self, time: T, goal: Goal<T>) -> PlannedStep<T> {
        let step = self.grid.step;
        let lost = self.lost(time, goal);
        let origin = self.origin.unwrap_or(time);
        let place = origin + goal.direction * (self.number + T::ONE) * step;
        // If rounding just misses the end, no tiny step remains.
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

    /// Checks that a planned step, which starts at `time`, is allowed after the steps in the
    /// report.
    #[inline(always)]
    pub(super) fn check(
        &self,
        planned: PlannedStep<T>,
        time: T,
        report: &Report<T>,
        steps_before: u64,
    ) -> Result<(), Failure<T>> {
        check_number(self.grid.step_limit, report, steps_before)?;
        // The time is so large that the step is lost in its rounding.
        if planned.end_time == time {
            return Err(Failure::StepTooSmall {
                step: planned.length,
                shortest: planned.lost,
            });
        }
        Ok(())
    }

    /// Halves the step after its equations could not be solved. Returns false if no more halvings
    /// are allowed.
    pub(super) fn halve(&mut self, planned: PlannedStep<T>) -> bool {
        let half = T::from_f64(0.5) * self.length;
        let may = self.halved < self.grid.halvings && half > planned.lost;
        if may {
            self.halved += 1;
            self.length = half;
        }
        may
    }

    /// Updates the position to the end of a completed step.
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

    /// Saves or restores the position.
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
