//! Solving for the rates of the stages: K_i = f(t + c_i h, y + h Σ_j a_ij K_j).

// One index into all lanes at once.
#![allow(clippy::needless_range_loop)]

use alloc::vec;
use alloc::vec::Vec;

use super::Solver;
use super::step::GaussStep;
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::NonFinite;
use crate::integrate::fixed::linear::Factored;
use crate::integrate::registers::{check_finite, numbers, numbers_in};
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::integrate::steps::Failure;
use crate::scalar::{Real, Scalar};
use crate::simd::Simd;

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
pub(super) struct Solution<T> {
    /// True while the iteration goes on.
    goes_on: bool,
    /// Why it has ended without an answer.
    pub(super) failure: Option<Failure<T>>,
    /// Evaluations of the step.
    pub(super) evaluations: u64,
    /// The smallest change so far, the last one, and the rounds in which it did not fall.
    best: T,
    last: T,
    without_progress: u32,
    /// Matrix of Newton's method and the step that it was made for.
    newton: Factored<T>,
    pub(super) newton_step: T,
    /// Right-hand side of its equations.
    right: Vec<T>,
}

impl<T: Real> Solution<T> {
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

    fn begin(&mut self, goes_on: bool) {
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

    fn give_up(&mut self, step: T, iterations: u32, change: T) {
        let step = step.abs();
        self.fail(Failure::NotSolved {
            step,
            iterations,
            change,
        });
    }

    /// Ends because rates are not finite, in a round of the iteration or before the first.
    fn stumble(&mut self, step: T, round: u32, place: NonFinite<T>) {
        // An iterate that ran away says nothing about the equations.
        if round > 0 && self.last > T::from_f64(RUNAWAY) {
            self.give_up(step, round, self.last);
        } else {
            self.fail(place.into());
        }
    }

    /// Judges the change of a round: ends where it is zero or rounding, or falls no more.
    fn judge(&mut self, step: T, round: u32, change: T, tolerance: T) {
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

impl<T: Real, R: Simd<T>> GaussStep<T, R> {
    /// Iterates the rates of the stages, from their increments in place, until
    /// the change is zero or rounding in each lane of `sought`: lanes that are done keep their
    /// rates.
    #[inline(always)]
    pub(super) fn solve<S: RightHandSide<R>>(
        &mut self,
        system: &mut S,
        span: StepSpan<R>,
        sought: &[bool],
    ) {
        for (solution, &sought) in self.solutions.iter_mut().zip(sought) {
            solution.begin(sought);
        }
        self.evaluate(system, span, 0);
        core::mem::swap(&mut self.rates, &mut self.change);
        if self.solver == Solver::Newton {
            self.differentiate(system, span);
        }
        let steps = span.step.to_chunk();
        for round in 1..=self.iteration_limit {
            if !self.goes_on() {
                return;
            }
            self.increments(span.step);
            self.evaluate(system, span, round);
            let changes = self.update(span.step).to_chunk();
            let lanes = steps.as_ref().iter().zip(changes.as_ref());
            for (solution, (&step, &change)) in self.solutions[..R::LANES].iter_mut().zip(lanes) {
                if solution.goes_on {
                    solution.judge(step, round, change, self.tolerance);
                }
            }
        }
        for (solution, &step) in self.solutions.iter_mut().zip(steps.as_ref()) {
            if solution.goes_on {
                solution.give_up(step, self.iteration_limit, solution.best);
            }
        }
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        let solutions = &self.solutions[..R::LANES];
        solutions.iter().any(|solution| solution.goes_on)
    }

    /// The lanes whose iteration goes on.
    #[inline(always)]
    fn going(&self) -> R::Mask {
        R::mask(|lane| self.solutions[lane].goes_on)
    }

    /// h Σ_j a_ij K_j, and the residue of the start.
    #[inline(always)]
    fn increments(&mut self, step: R) {
        let (n, s) = (self.start.len(), self.table.nodes.len());
        let zero = R::from_f64(0.0);
        for (i, row) in self.table.matrix.chunks(s).enumerate() {
            for k in 0..n {
                let (mut main, mut rest) = (zero, zero);
                for (j, &(large, small)) in row.iter().enumerate() {
                    main = main + R::from_f64(large) * self.rates[j * n + k];
                    rest = rest + R::from_f64(small) * self.rates[j * n + k];
                }
                self.increments[i * n + k] = step * main + (step * rest + self.residue[k]);
            }
        }
    }

    /// Rates at the stages' states, into `change`. Lanes in which they are not finite end
    /// there.
    #[inline(always)]
    fn evaluate<S: RightHandSide<R>>(&mut self, system: &mut S, span: StepSpan<R>, round: u32) {
        let n = self.start.len();
        for (i, &node) in self.table.nodes.iter().enumerate() {
            for (k, value) in self.stage.iter_mut().enumerate() {
                *value = self.start[k] + self.increments[i * n + k];
            }
            let rates = &mut self.change[i * n..(i + 1) * n];
            let time = span.time + R::from_f64(node) * span.step;
            system.write(time, &self.stage, rates);
            let finite = check_finite(R::from_f64(0.0), rates).to_chunk();
            let mut failed = false;
            // As many as the compiler knows.
            let solutions = &mut self.solutions[..R::LANES];
            for (solution, finite) in solutions.iter_mut().zip(finite.as_ref()) {
                solution.evaluations += u64::from(solution.goes_on);
                failed |= solution.goes_on & !finite.is_finite();
            }
            if failed {
                self.stumble(StepSpan { time, ..span }, round, finite.as_ref());
                if !self.goes_on() {
                    return;
                }
            }
        }
    }

    /// Ends the lanes in which the rates of a stage, at the time of `span`, are not finite.
    #[cold]
    fn stumble(&mut self, span: StepSpan<R>, round: u32, finite: &[T]) {
        for (lane, solution) in self.solutions.iter_mut().enumerate() {
            if solution.goes_on && !finite[lane].is_finite() {
                let place = NonFinite {
                    time: numbers(span.time)[lane],
                    values: numbers_in(&self.stage, lane),
                };
                solution.stumble(numbers(span.step)[lane], round, place);
            }
        }
    }

    /// Moves the rates to the new ones in `change`, in lanes that go on; returns the largest
    /// change of an increment, relative to the size of its component.
    #[inline(always)]
    fn update(&mut self, step: R) -> R {
        let n = self.start.len();
        for (new, &old) in self.change.iter_mut().zip(&self.rates) {
            *new = *new - old;
        }
        if self.solver == Solver::Newton {
            self.newton();
        }
        let going = self.going();
        let mut largest = R::from_f64(0.0);
        for (index, (rate, &change)) in self.rates.iter_mut().zip(&self.change).enumerate() {
            *rate = (*rate + change).choose(*rate, going);
            let size = self.sizes[index % n].larger_size(step * *rate);
            largest = largest.larger_size(step * change / size);
        }
        largest
    }

    /// Solves the equations of Newton's method for the changes, lane by lane.
    #[inline(always)]
    fn newton(&mut self) {
        for (lane, solution) in self.solutions.iter_mut().enumerate() {
            if !solution.goes_on {
                continue;
            }
            for (right, &change) in solution.right.iter_mut().zip(&self.change) {
                *right = change.to_chunk().as_ref()[lane];
            }
            solution.newton.solve(&mut solution.right);
            let own = R::mask(|other| other == lane);
            for (&right, change) in solution.right.iter().zip(&mut self.change) {
                *change = R::splat(right).choose(*change, own);
            }
        }
    }

    /// Derivatives of the rates in the middle of the step, by differences, and
    /// the matrix 1 − h a ⊗ ∂f/∂y of Newton's method, in lanes whose matrix is of another
    /// step.
    #[inline(always)]
    fn differentiate<S: RightHandSide<R>>(&mut self, system: &mut S, span: StepSpan<R>) {
        let steps = numbers(span.step);
        let due = |lane: usize, solution: &Solution<T>| {
            solution.goes_on && solution.newton_step != steps[lane]
        };
        let mut lanes = self.solutions.iter().enumerate();
        if !lanes.any(|(lane, solution)| due(lane, solution)) {
            return;
        }
        let n = self.start.len();
        let middle = span.time + R::from_f64(0.5) * span.step;
        self.stage.copy_from_slice(&self.start);
        system.write(middle, &self.stage, &mut self.other);
        let root = R::splat(Scalar::sqrt(T::EPSILON));
        let (zero, one) = (R::from_f64(0.0), R::from_f64(1.0));
        for column in 0..n {
            let value = self.stage[column];
            let shifted = value + root * (one + value.larger_size(zero));
            let difference = shifted - value;
            self.stage[column] = shifted;
            // Into the first rows of `increments`, which are made anew later.
            let rates = &mut self.increments[..n];
            system.write(middle, &self.stage, rates);
            for (row, (&rate, &other)) in rates.iter().zip(&self.other).enumerate() {
                self.derivatives[row * n + column] = (rate - other) / difference;
            }
            self.stage[column] = value;
        }
        let s = self.table.nodes.len();
        for (lane, solution) in self.solutions.iter_mut().enumerate() {
            if !due(lane, solution) {
                continue;
            }
            solution.evaluations += n as u64 + 1;
            solution.newton_step = steps[lane];
            let entries = &mut solution.newton.entries;
            for (i, row) in self.table.matrix.chunks(s).enumerate() {
                for (j, &(large, small)) in row.iter().enumerate() {
                    let weight = steps[lane] * T::from_f64(large + small);
                    for k in 0..n {
                        for l in 0..n {
                            let same = i == j && k == l;
                            let one = if same { T::ONE } else { T::ZERO };
                            let derivative = self.derivatives[k * n + l].to_chunk();
                            let derivative = derivative.as_ref()[lane];
                            entries[(i * n + k) * n * s + j * n + l] = one - weight * derivative;
                        }
                    }
                }
            }
            if !solution.newton.factorise() {
                solution.give_up(steps[lane], 0, T::NAN);
            }
        }
    }
}
