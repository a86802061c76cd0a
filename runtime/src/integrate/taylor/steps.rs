//! The Taylor series method during a run of a single trajectory.

// A sealed trait names the type.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;

use super::root::least_inverse_roots;
use crate::integrate::checkpoint::Memory;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::options::Options;
use crate::integrate::piece::{Ahead, Form, LastTerms, Piece};
use crate::integrate::request::all_finite;
use crate::integrate::steps::{Failure, Goal, StepLimits, Steps};
use crate::scalar::Real;
use crate::simd::Quad;
use crate::simd::dispatch::in_fours;
use crate::system::TaylorOde;

/// Data of the Taylor series method during a run, for states of a fixed dimension and polynomials
/// of a fixed order.
#[derive(Clone, Debug)]
pub struct TaylorSteps<T> {
    limits: StepLimits<T>,
    compensated: bool,
    /// True before the first step.
    first: bool,
    relative: Vec<T>,
    absolute: Vec<T>,
    order: usize,
    /// exp(−2/(order − 1)).
    safety: T,
    /// State at the start of the step.
    start: Vec<T>,
    /// State at the end of the step.
    end: Vec<T>,
    /// Rounding error of `start`, which compensated sums add to it; zero otherwise.
    start_residue: Vec<T>,
    /// Rounding error of `end`.
    end_residue: Vec<T>,
    /// Taylor coefficients at the start of the step, order by order.
    coefficients: Vec<T>,
    /// Workspace in which the system computes the coefficients.
    work: Vec<Quad<T>>,
    /// Length of the step; negative in a run backwards in time.
    step: T,
}

impl<T: Real> TaylorSteps<T> {
    pub(super) fn new(options: &Options<T>, order: usize, workspace: usize, start: &[T]) -> Self {
        let n = start.len();
        Self {
            limits: StepLimits::new(options),
            compensated: options.compensated,
            first: true,
            relative: options.relative.expand(n),
            absolute: options.absolute.expand(n),
            order,
            safety: super::safety(order),
            start: start.to_vec(),
            end: vec![T::ZERO; n],
            start_residue: vec![T::ZERO; n],
            end_residue: vec![T::ZERO; n],
            coefficients: vec![T::ZERO; (order + 1) * n],
            work: vec![Quad([T::ZERO; 4]); workspace],
            step: T::ZERO,
        }
    }

    /// Returns the step length at which the larger of the last two terms of the polynomial,
    /// relative to its tolerance, is one.
    fn step_length(&self) -> T {
        let n = self.start.len();
        let mut ratios = [T::ZERO; 2];
        in_fours::<T, _>(LastTerms {
            coefficients: &self.coefficients[(self.order - 1) * n..],
            start: &self.start,
            relative: &self.relative,
            absolute: &self.absolute,
            ratios: &mut ratios,
        });
        let [before, last] = ratios;
        let [step] = least_inverse_roots(1, (&[before], self.order - 1), (&[last], self.order));
        self.safety * step
    }

    /// Returns true if the last two terms of the polynomial are finite.
    fn has_finite_end(&self) -> bool {
        let n = self.start.len();
        all_finite(&self.coefficients[(self.order - 1) * n..])
    }

    /// Computes the state at the end of a step of length `step`.
    #[inline(always)]
    fn make(&mut self, step: T) {
        self.step = step;
        let residues = (&self.start_residue[..], &mut self.end_residue[..]);
        in_fours::<T, _>(Ahead {
            coefficients: &self.coefficients,
            tau: step,
            start: &self.start,
            end: &mut self.end,
            residues: self.compensated.then_some(residues),
        });
    }
}

impl<T: Real, O: TaylorOde<T> + ?Sized> Steps<T, O> for TaylorSteps<T> {
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>> {
        system.report.evaluations += self.order as u64;
        let (coefficients, work) = (&mut self.coefficients, &mut self.work);
        system.ode.taylor(time, &self.start, coefficients, work);
        // What is not finite further down shows in the end of the step.
        if !self.has_finite_end() {
            return Err(NonFinite::new(time, &self.start).into());
        }
        let step = self.step_length().min(self.limits.bound(self.first));
        system.report.next_step = match step.is_finite() {
            true => step,
            false => goal.distance(time),
        };
        let (end_time, last) = goal.plan(time, step);
        self.limits
            .check(system.report, goal.steps_before, (time, step, last))?;
        // The difference of the rounded times, so that they add up.
        self.make(end_time - time);
        if !all_finite(&self.end) {
            let at_start = !all_finite(&self.coefficients);
            let (time, values) = if at_start {
                (time, &self.start)
            } else {
                (end_time, &self.end)
            };
            return Err(NonFinite::new(time, values).into());
        }
        self.first = false;
        system.report.accept(self.step.abs());
        Ok(end_time)
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: Form::Taylor,
            start: &self.start,
            end: &self.end,
            terms: [&self.coefficients, &[]],
            length: self.step,
        }
    }

    fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_residue, &mut self.end_residue);
    }

    fn restart(&mut self, values: &[T]) {
        self.start.copy_from_slice(values);
        self.start_residue.fill(T::ZERO);
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.flag(&mut self.first);
        memory.numbers(&mut self.start_residue);
    }
}
