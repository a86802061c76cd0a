//! Convergence of the iteration that solves the equations of an implicit step, in one lane.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::NonFinite;
use crate::integrate::fixed::linear::Factored;
use crate::integrate::steps::Failure;
use crate::scalar::Real;

/// Largest change (in units of the rounding error) that counts as convergence once the changes no
/// longer decrease.
const ROUNDING: f64 = 1e2;

/// Largest change, in units of rounding, that counts as rounding if it has not decreased for two
/// iterations.
const NOISE: f64 = 1e4;

/// Number of iterations without progress after which a fixed-point iteration has failed.
const PATIENCE: u32 = 3;

/// Relative change above which rates that are not finite mean that the iteration has diverged; the
/// equations are then not at fault.
const RUNAWAY: f64 = 1e-3;

/// Number of iterations after which the matrix of derivatives is computed again.
const STALE: u32 = 8;

/// Iteration in one lane: its convergence, and the matrix of Newton's method.
#[derive(Clone, Debug)]
pub(super) struct LaneIteration<T> {
    /// True while the iteration continues.
    pub(super) goes_on: bool,
    /// Reason why the iteration ended without a solution.
    pub(super) failure: Option<Failure<T>>,
    /// Number of evaluations of the right-hand side in the step.
    pub(super) evaluations: u64,
    /// Smallest change so far, last change, and number of iterations in which the change did not
    /// decrease.
    pub(super) best: T,
    last: T,
    without_progress: u32,
    /// Matrix of Newton's method, and the step length for which it was computed.
    pub(super) newton: Factored<T>,
    pub(super) newton_step: T,
    /// Right-hand side of the equations of Newton's method.
    pub(super) right: Vec<T>,
}

impl<T: Real> LaneIteration<T> {
    /// Allocates the memory for Newton's method with `size` unknowns.
    pub(super) fn new(size: usize) -> Self {
        Self {
            goes_on: false,
            failure: None,
            evaluations: 0,
            best: T::ZERO,
            last: T::ZERO,
            without_progress: 0,
            newton: Factored::new(size),
            newton_step: T::ZERO,
            right: vec![T::ZERO; size],
        }
    }

    pub(super) fn begin(&mut self, goes_on: bool) {
        let infinite = T::ONE / T::ZERO;
        (self.goes_on, self.failure, self.evaluations) = (goes_on, None, 0);
        (self.best, self.last, self.without_progress) = (infinite, infinite, 0);
    }

    /// Ends the iteration without a solution.
    fn fail(&mut self, failure: Failure<T>) {
        self.newton_step = T::ZERO;
        self.goes_on = false;
        self.failure = Some(failure);
    }

    pub(super) fn give_up(&mut self, step: T, iterations: u32, change: T) {
        let step = step.abs();
        self.fail(Failure::NotSolved {
            step,
            iterations,
            change,
        });
    }

    /// Ends the iteration because rates are not finite, in iteration number `round` (0: before the
    /// first).
    pub(super) fn stumble(&mut self, step: T, round: u32, place: NonFinite<T>) {
        // An iterate that diverged does not show that the equations have no finite rates.
        if round > 0 && self.last > T::from_f64(RUNAWAY) {
            self.give_up(step, round, self.last);
        } else {
            self.fail(place.into());
        }
    }

    /// Ends the iteration if the change in this iteration is zero or rounding, or has stopped
    /// decreasing.
    pub(super) fn judge(&mut self, step: T, round: u32, change: T, tolerance: T) {
        self.last = change;
        if change < self.best {
            self.best = change;
            self.without_progress = 0;
        } else {
            self.without_progress += 1;
        }
        let rounding = T::from_f64(ROUNDING) * T::EPSILON;
        let noise = T::from_f64(NOISE) * T::EPSILON;
        // If the change has stopped falling, only rounding is left. It may fall in every second
        // round only.
        let settled = change <= tolerance
            || (self.without_progress == 1 && change <= rounding)
            || (self.without_progress > 1 && change <= noise);
        if settled {
            self.goes_on = false;
            if round > STALE {
                self.newton_step = T::ZERO;
            }
        } else if self.without_progress > PATIENCE {
            self.give_up(step, round, change);
        }
    }

    /// Saves or restores the numbers on which later steps depend.
    pub(super) fn remember(&mut self, memory: &mut Memory<T>) {
        self.newton.remember(memory);
        memory.number(&mut self.newton_step);
    }
}
