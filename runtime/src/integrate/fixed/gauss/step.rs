//! Workspace of a Gauss step, and the parts of the computation of a step.

// The type is public because a sealed trait mentions it.
#![allow(unreachable_pub)]
// One index runs through several vectors at once.
#![allow(clippy::needless_range_loop)]

use alloc::vec;
use alloc::vec::Vec;

use super::iteration::LaneIteration;
use super::{Gauss, Solver};
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::fixed::grid::{Corrected, FixedStep};
use crate::integrate::piece::{Form, GaussOrder, GaussTable, Piece};
use crate::integrate::registers::smallest_divisor;
use crate::integrate::request::all_finite;
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::integrate::steps::Failure;
use crate::scalar::{Real, two_sum};
use crate::simd::Simd;
use crate::system::Ode;

/// Data of a Gauss method during a run: for one trajectory (a register of one lane), or for one
/// trajectory in each lane of a register.
#[derive(Clone, Debug)]
pub struct GaussStep<T, R> {
    order: GaussOrder,
    pub(super) table: &'static GaussTable,
    pub(super) solver: Solver,
    pub(super) tolerance: T,
    pub(super) iteration_limit: u32,
    pub(in crate::integrate::fixed) start: Vec<R>,
    pub(in crate::integrate::fixed) end: Vec<R>,
    /// Rounding error of `start`, which compensated sums add to it.
    pub(in crate::integrate::fixed) residue: Vec<R>,
    pub(in crate::integrate::fixed) end_residue: Vec<R>,
    /// Largest magnitude of each component so far, by which its changes are divided. The present
    /// magnitude would not do, because a component can pass through zero. It is at least the
    /// smallest divisor, so that the relative change of a component that stays zero is zero, not
    /// 0/0.
    pub(in crate::integrate::fixed) sizes: Vec<R>,
    /// Rates of the stages, one after the other.
    pub(super) rates: Vec<R>,
    /// Increments of the state from the start to each stage, one after the other.
    pub(super) increments: Vec<R>,
    /// Change of the rates in an iteration.
    pub(super) change: Vec<R>,
    /// State at which rates are evaluated.
    pub(super) stage: Vec<R>,
    /// Rates at the start of the run, or at a shifted state for difference quotients.
    pub(in crate::integrate::fixed) other: Vec<R>,
    /// Length of the step to which `rates` belong. Zero before the first step and after a failed
    /// one, because rates cannot be extrapolated then.
    pub(super) step: R,
    /// Derivatives of the rates by the state, row by row.
    pub(super) derivatives: Vec<R>,
    /// Iteration of each lane.
    pub(super) iterations: Vec<LaneIteration<T>>,
}

impl<T: Real, R: Simd<T>> GaussStep<T, R> {
    pub(in crate::integrate::fixed) fn new(method: &Gauss<T>, start: Vec<R>) -> Self {
        let table = method.order.table();
        let (n, s) = (start.len(), table.nodes.len());
        let matrix = match method.solver {
            Solver::FixedPoint => 0,
            Solver::Newton => n,
        };
        let (zero, smallest) = (R::from_f64(0.0), R::splat(smallest_divisor()));
        let zeros = |count: usize| vec![zero; count];
        Self {
            order: method.order,
            table,
            solver: method.solver,
            tolerance: method.tolerance,
            iteration_limit: method.iteration_limit,
            sizes: start
                .iter()
                .map(|value| value.larger_size(smallest))
                .collect(),
            start,
            end: zeros(n),
            residue: zeros(n),
            end_residue: zeros(n),
            rates: zeros(n * s),
            increments: zeros(n * s),
            change: zeros(n * s),
            stage: zeros(n),
            other: zeros(n),
            step: zero,
            derivatives: zeros(matrix * matrix),
            iterations: (0..R::LANES)
                .map(|_| LaneIteration::new(matrix * s))
                .collect(),
        }
    }

    /// Evaluates the rates at the start. The first increments are guessed from them if there is no
    /// previous step.
    #[inline(always)]
    pub(in crate::integrate::fixed) fn evaluate_start<S: RightHandSide<R>>(
        &mut self,
        system: &mut S,
        time: R,
    ) {
        let n = system.dimension();
        system.write(time, &self.start[..n], &mut self.other[..n]);
    }

    /// Solves the step in the lanes of `sought`, and computes the state at its end where the
    /// solution was found.
    #[inline(always)]
    pub(in crate::integrate::fixed) fn make_step<S: RightHandSide<R>>(
        &mut self,
        system: &mut S,
        span: StepSpan<R>,
        sought: &[bool],
    ) {
        self.guess(span.step);
        self.solve(system, span, sought);
        let solved = R::mask(|lane| self.iterations[lane].failure.is_none());
        // The rates of a failed step are useless for the next guess.
        self.step = span.step.choose(R::from_f64(0.0), solved);
        self.finish(span.step, solved);
    }

    /// Guesses the increments of the stages from the polynomial of the previous step, or from the
    /// rates at the start if there is none.
    #[inline(always)]
    fn guess(&mut self, step: R) {
        let before = self.step.to_chunk();
        let is_new = |lane: usize| before.as_ref()[lane] == T::ZERO;
        if !(0..R::LANES).all(is_new) {
            self.extrapolate(step);
        }
        if (0..R::LANES).any(is_new) {
            let n = self.start.len();
            let mask = R::mask(is_new);
            for (i, &node) in self.table.nodes.iter().enumerate() {
                let part = R::from_f64(node) * step;
                for k in 0..n {
                    let value = &mut self.increments[i * n + k];
                    *value = (part * self.other[k]).choose(*value, mask);
                }
            }
        }
    }

    /// Extrapolates the increments of the stages with the polynomial of the previous step.
    #[inline(always)]
    fn extrapolate(&mut self, step: R) {
        let (n, s) = (self.start.len(), self.table.nodes.len());
        let (zero, one) = (R::from_f64(0.0), R::from_f64(1.0));
        let ratio = step / self.step;
        for (i, &node) in self.table.nodes.iter().enumerate() {
            let own = &mut self.increments[i * n..(i + 1) * n];
            own.fill(zero);
            let place = one + ratio * R::from_f64(node);
            for j in 0..s {
                let weight =
                    self.step * (self.order.integral(j, place) - self.order.integral(j, one));
                for (value, &rate) in own.iter_mut().zip(&self.rates[j * n..(j + 1) * n]) {
                    *value = *value + weight * rate;
                }
            }
        }
    }

    /// Computes the state at the end of the step from the rates of the stages, in the lanes of
    /// `solved`.
    #[inline(always)]
    fn finish(&mut self, step: R, solved: R::Mask) {
        let n = self.start.len();
        let zero = R::from_f64(0.0);
        for i in 0..n {
            let (mut main, mut rest) = (zero, zero);
            for (j, &(large, small)) in self.table.weights.iter().enumerate() {
                main = main + R::from_f64(large) * self.rates[j * n + i];
                rest = rest + R::from_f64(small) * self.rates[j * n + i];
            }
            let increment = step * main + (step * rest + self.residue[i]);
            (self.end[i], self.end_residue[i]) = two_sum(self.start[i], increment);
            let size = self.sizes[i].larger_size(self.end[i]);
            self.sizes[i] = size.choose(self.sizes[i], solved);
        }
    }

    /// Writes the solution at the fraction `s` (0 to 1) of the step.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(in crate::integrate::fixed) fn value(&self, s: R, out: &mut [R]) {
        let weights = self.order.weights(self.step, s);
        let n = self.start.len();
        for i in 0..n {
            out[i] = crate::integrate::piece::weigh(&weights, self.start[i], &self.rates, n, i);
        }
    }

    /// Returns the number of evaluations of the step in a lane.
    #[cfg(feature = "std")]
    pub(in crate::integrate::fixed) fn evaluations(&self, lane: usize) -> u64 {
        self.iterations[lane].evaluations
    }

    /// Returns true if the step is solved in a lane.
    #[cfg(feature = "std")]
    pub(in crate::integrate::fixed) fn is_solved(&self, lane: usize) -> bool {
        self.iterations[lane].failure.is_none()
    }

    /// Returns, and removes, the reason why the step could not be solved in a lane.
    pub(in crate::integrate::fixed) fn take_failure(&mut self, lane: usize) -> Option<Failure<T>> {
        self.iterations.get_mut(lane)?.failure.take()
    }

    /// Sets the state of a lane for a new trajectory, without memory of earlier steps. `None`
    /// empties the lane.
    #[cfg(feature = "std")]
    pub(in crate::integrate::fixed) fn set_lane(&mut self, lane: usize, values: Option<&[T]>) {
        use crate::integrate::registers::set_lane;
        for i in 0..self.start.len() {
            let value = values.map_or(T::ZERO, |values| values[i]);
            set_lane(&mut self.start[i], lane, value);
            set_lane(
                &mut self.sizes[i],
                lane,
                value.abs().max(smallest_divisor()),
            );
            set_lane(&mut self.residue[i], lane, T::ZERO);
            set_lane(&mut self.other[i], lane, T::ZERO);
        }
        for rate in &mut self.rates {
            set_lane(rate, lane, T::ZERO);
        }
        set_lane(&mut self.step, lane, T::ZERO);
        self.iterations[lane].newton_step = T::ZERO;
    }
}

impl<T: Real, O: Ode<T> + ?Sized> FixedStep<T, O> for GaussStep<T, T> {
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        self.evaluate_start(system, time);
        if all_finite(&self.other) {
            Ok(())
        } else {
            Err(NonFinite::new(time, &self.start))
        }
    }

    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.make_step(system, StepSpan { time, step }, &[true]);
        if let Some(failure) = self.take_failure(0) {
            FixedStep::<T, O>::begin(self, system, time)?;
            return Err(failure);
        }
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

    /// Sets the start of the next step. The matrix of Newton's method is kept: it affects only the
    /// speed of convergence, and is computed again if that becomes slow.
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
        for iteration in &mut self.iterations {
            iteration.remember(memory);
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> Corrected<T, O> for GaussStep<T, T> {
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
