//! How far the iteration of one lane has come.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::NonFinite;
use crate::integrate::fixed::linear::Factored;
use crate::integrate::steps::Failure;
use crate::scalar::Real;

/// Below this, in units of rounding, a change that does not fall is rounding.
const ROUNDING: f64 = 1e2;

/// Below this, a change that has not fallen for two rounds is rounding too.
const NOISE: f64 = 1e4;

/// A fixed point that comes no nearer in more rounds than these is none.
const PATIENCE: u32 = 3;

/// Rates that are not finite after a relative change above this are those of an
/// iterate that ran away.
const RUNAWAY: f64 = 1e-3;

/// A matrix of derivatives that took more rounds than this is made anew.
const STALE: u32 = 8;

/// What one lane has of its own: how far its iteration has come, and the matrix of Newton's
/// method.
#[derive(Clone, Debug)]
pub(super) struct LaneIteration<T> {
    /// True while the iteration goes on.
    pub(super) goes_on: bool,
    /// Why it has ended without an answer.
    pub(super) failure: Option<Failure<T>>,
    /// Evaluations of the step.
    pub(super) evaluations: u64,
    /// The smallest change so far, the last one, and the rounds in which it did not fall.
    pub(super) best: T,
    last: T,
    without_progress: u32,
    /// Matrix of Newton's method and the step that it was made for.
    pub(super) newton: Factored<T>,
    pub(super) newton_step: T,
    /// Right-hand side of its equations.
    pub(super) right: Vec<T>,
}

impl<T: Real> LaneIteration<T> {
    /// Room for Newton's method with `size` unknowns.
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

    /// Ends without an answer.
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

    /// Ends because rates are not finite, in a round of the iteration or before the first.
    pub(super) fn stumble(&mut self, step: T, round: u32, place: NonFinite<T>) {
        // An iterate that ran away says nothing about the equations.
        if round > 0 && self.last > T::from_f64(RUNAWAY) {
            self.give_up(step, round, self.last);
        } else {
            self.fail(place.into());
        }
    }

    /// Judges the change of a round: ends where it is zero or rounding, or falls no more.
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
        // Where the change no longer falls, rounding is all that is left.
        // It may fall in every second round only.
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

    /// Saves or restores what later steps depend on.
    pub(super) fn remember(&mut self, memory: &mut Memory<T>) {
        self.newton.remember(memory);
        memory.number(&mut self.newton_step);
    }
}
