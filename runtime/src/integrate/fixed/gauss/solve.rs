//! Iterative solution of the equations of the stages, K_i = f(t + c_i h, y + h Σ_j a_ij K_j), with
//! step length h and coefficients a, c.

// One index runs through the arrays of all lanes.
#![allow(clippy::needless_range_loop)]

use super::Solver;
use super::iteration::LaneIteration;
use super::step::GaussStep;
use crate::integrate::evaluator::NonFinite;
use crate::integrate::registers::{check_finite, numbers, numbers_in};
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::scalar::{Real, Scalar};
use crate::simd::Simd;

impl<T: Real, R: Simd<T>> GaussStep<T, R> {
    /// Solves for the rates of the stages by iteration, starting from the present increments, until
    /// the change is zero or rounding in each lane of `sought`. Lanes that have finished keep their
    /// rates.
    #[inline(always)]
    pub(super) fn solve<S: RightHandSide<R>>(
        &mut self,
        system: &mut S,
        span: StepSpan<R>,
        sought: &[bool],
    ) {
        for (iteration, &sought) in self.iterations.iter_mut().zip(sought) {
            iteration.begin(sought);
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
            for (iteration, (&step, &change)) in self.iterations[..R::LANES].iter_mut().zip(lanes) {
                if iteration.goes_on {
                    iteration.judge(step, round, change, self.tolerance);
                }
            }
        }
        for (iteration, &step) in self.iterations.iter_mut().zip(steps.as_ref()) {
            if iteration.goes_on {
                iteration.give_up(step, self.iteration_limit, iteration.best);
            }
        }
    }

    #[inline(always)]
    fn goes_on(&self) -> bool {
        let iterations = &self.iterations[..R::LANES];
        iterations.iter().any(|iteration| iteration.goes_on)
    }

    /// Returns the lanes in which the iteration continues.
    #[inline(always)]
    fn going(&self) -> R::Mask {
        R::mask(|lane| self.iterations[lane].goes_on)
    }

    /// Computes the increments h Σ_j a_ij K_j of the stages, plus the rounding error of the start.
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

    /// Evaluates the rates at the states of the stages and writes them to `change`. In lanes with
    /// rates that are not finite, the iteration ends.
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
            // A length that the compiler knows.
            let iterations = &mut self.iterations[..R::LANES];
            for (iteration, finite) in iterations.iter_mut().zip(finite.as_ref()) {
                iteration.evaluations += u64::from(iteration.goes_on);
                failed |= iteration.goes_on & !finite.is_finite();
            }
            if failed {
                self.stumble(StepSpan { time, ..span }, round, finite.as_ref());
                if !self.goes_on() {
                    return;
                }
            }
        }
    }

    /// Ends the iteration of the lanes in which the rates of a stage, at the time of `span`, are
    /// not finite.
    #[cold]
    fn stumble(&mut self, span: StepSpan<R>, round: u32, finite: &[T]) {
        for (lane, iteration) in self.iterations.iter_mut().enumerate() {
            if iteration.goes_on && !finite[lane].is_finite() {
                let place = NonFinite {
                    time: numbers(span.time)[lane],
                    values: numbers_in(&self.stage, lane),
                };
                iteration.stumble(numbers(span.step)[lane], round, place);
            }
        }
    }

    /// Replaces the rates by the new ones in `change`, in lanes that continue. Returns the largest
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

    /// Solves the linear equations of Newton's method for the changes, lane by lane.
    #[inline(always)]
    fn newton(&mut self) {
        for (lane, iteration) in self.iterations.iter_mut().enumerate() {
            if !iteration.goes_on {
                continue;
            }
            for (right, &change) in iteration.right.iter_mut().zip(&self.change) {
                *right = change.to_chunk().as_ref()[lane];
            }
            iteration.newton.solve(&mut iteration.right);
            let own = R::mask(|other| other == lane);
            for (&right, change) in iteration.right.iter().zip(&mut self.change) {
                *change = R::splat(right).choose(*change, own);
            }
        }
    }

    /// Computes, in lanes whose matrix is for another step length, the matrix 1 − h a ⊗ ∂f/∂y of
    /// Newton's method. The derivatives ∂f/∂y of the rates are differences in the middle of the
    /// step.
    #[inline(always)]
    fn differentiate<S: RightHandSide<R>>(&mut self, system: &mut S, span: StepSpan<R>) {
        let steps = numbers(span.step);
        let due = |lane: usize, iteration: &LaneIteration<T>| {
            iteration.goes_on && iteration.newton_step != steps[lane]
        };
        let mut lanes = self.iterations.iter().enumerate();
        if !lanes.any(|(lane, iteration)| due(lane, iteration)) {
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
            // The first rows of `increments` serve as memory; they are computed again later.
            let rates = &mut self.increments[..n];
            system.write(middle, &self.stage, rates);
            for (row, (&rate, &other)) in rates.iter().zip(&self.other).enumerate() {
                self.derivatives[row * n + column] = (rate - other) / difference;
            }
            self.stage[column] = value;
        }
        let s = self.table.nodes.len();
        for (lane, iteration) in self.iterations.iter_mut().enumerate() {
            if !due(lane, iteration) {
                continue;
            }
            iteration.evaluations += n as u64 + 1;
            iteration.newton_step = steps[lane];
            let entries = &mut iteration.newton.entries;
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
            if !iteration.newton.factorise() {
                iteration.give_up(steps[lane], 0, T::NAN);
            }
        }
    }
}
