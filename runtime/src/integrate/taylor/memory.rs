//! The vectors that a run works on, allocated once, and what is done with them.

use alloc::vec;
use alloc::vec::Vec;

use super::polynomial::{Ahead, LastTerms};
use super::root::least_inverse_root;
use crate::integrate::dense::{DenseError, Interpolant};
use crate::integrate::options::Options;
use crate::integrate::request::all_finite;
use crate::scalar::Real;
use crate::simd::Quad;
use crate::simd::run_packs;

/// Workspace for a state of fixed dimension and polynomials of fixed order.
#[derive(Clone, Debug)]
pub(super) struct Memory<T> {
    relative: Vec<T>,
    absolute: Vec<T>,
    order: usize,
    /// Reciprocals of the last two orders.
    over_orders: [f64; 2],
    /// exp(−2/(order − 1)).
    safety: T,
    /// State at the start of the step.
    pub(super) start: Vec<T>,
    /// State at the end of the step.
    pub(super) end: Vec<T>,
    /// Rounding error of `start`, to be added to it: zero unless the sums are
    /// compensated.
    start_residue: Vec<T>,
    /// Rounding error of `end`.
    end_residue: Vec<T>,
    /// Taylor coefficients at the start, order by order.
    pub(super) coefficients: Vec<T>,
    /// Where the system forms them.
    pub(super) work: Vec<Quad<T>>,
    /// Length of the step, with its sign.
    step: T,
}

impl<T: Real> Memory<T> {
    pub(super) fn new(options: &Options<T>, order: usize, workspace: usize, start: &[T]) -> Self {
        let n = start.len();
        Self {
            relative: options.relative.expand(n),
            absolute: options.absolute.expand(n),
            order,
            over_orders: [order - 1, order].map(|order| 1.0 / order as f64),
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

    /// Length of the step by the last two terms: the larger of them, in units
    /// of its tolerance, reaches one.
    pub(super) fn step_length(&self) -> T {
        let n = self.start.len();
        let mut ratios = [T::ZERO; 2];
        run_packs::<T, _>(LastTerms {
            coefficients: &self.coefficients[(self.order - 1) * n..],
            start: &self.start,
            relative: &self.relative,
            absolute: &self.absolute,
            ratios: &mut ratios,
        });
        let [before, last] = ratios.map(T::to_f64);
        let [over_before, over_last] = self.over_orders;
        let step = least_inverse_root([(before, over_before), (last, over_last)]);
        self.safety * T::from_f64(step)
    }

    /// Whether the last two terms are finite.
    pub(super) fn has_finite_end(&self) -> bool {
        let n = self.start.len();
        all_finite(&self.coefficients[(self.order - 1) * n..])
    }

    /// The state at the end of a step of length `step`.
    pub(super) fn make(&mut self, step: T, compensated: bool) {
        self.step = step;
        let residues = (&self.start_residue[..], &mut self.end_residue[..]);
        run_packs::<T, _>(Ahead {
            coefficients: &self.coefficients,
            tau: step,
            start: &self.start,
            end: &mut self.end,
            residues: compensated.then_some(residues),
        });
    }

    /// Makes the end of the step the start of the next one.
    pub(super) fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_residue, &mut self.end_residue);
    }
}

impl<T: Real> Interpolant<T> for Memory<T> {
    fn start(&self) -> &[T] {
        &self.start
    }

    fn end(&self) -> &[T] {
        &self.end
    }

    fn prepare(&mut self) -> Result<u64, DenseError<T>> {
        Ok(0)
    }

    fn value(&self, fraction: T, out: &mut [T]) {
        run_packs::<T, _>(Ahead {
            coefficients: &self.coefficients,
            tau: fraction * self.step,
            start: &self.start,
            end: out,
            residues: None,
        });
    }
}
