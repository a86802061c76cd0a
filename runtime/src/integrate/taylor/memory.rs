//! The vectors that a run works on, allocated once, and what is done with them.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::dense::{DenseError, Interpolant};
use crate::integrate::options::Options;
use crate::integrate::sum::two_sum;
use crate::scalar::Real;

/// Workspace for a state of fixed dimension and polynomials of fixed order.
#[derive(Clone, Debug)]
pub(super) struct Memory<T> {
    relative: Vec<T>,
    absolute: Vec<T>,
    order: usize,
    /// exp(−0.7/(order − 1)).
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
    pub(super) factors: Vec<T>,
    /// Length of the step, with its sign.
    step: T,
}

impl<T: Real> Memory<T> {
    pub(super) fn new(options: &Options<T>, order: usize, factors: usize, start: &[T]) -> Self {
        let n = start.len();
        let exponent = T::from_f64(-0.7) / T::from_f64((order - 1) as f64);
        Self {
            relative: options.relative.expand(n),
            absolute: options.absolute.expand(n),
            order,
            safety: T::from_f64(core::f64::consts::E).powf(exponent),
            start: start.to_vec(),
            end: vec![T::ZERO; n],
            start_residue: vec![T::ZERO; n],
            end_residue: vec![T::ZERO; n],
            coefficients: vec![T::ZERO; (order + 1) * n],
            factors: vec![T::ZERO; order.saturating_sub(1) * factors],
            step: T::ZERO,
        }
    }

    /// Length of the step by the last two terms: the larger of them, in units
    /// of its tolerance, reaches one.
    pub(super) fn step_length(&self) -> T {
        let of_order = |order: usize| {
            let exponent = T::ONE / T::from_f64(order as f64);
            (T::ONE / self.scaled_norm(order)).powf(exponent)
        };
        self.safety * of_order(self.order - 1).min(of_order(self.order))
    }

    /// The largest coefficient of an order, each in units of the tolerance of
    /// its component.
    fn scaled_norm(&self, order: usize) -> T {
        let n = self.start.len();
        let row = &self.coefficients[order * n..][..n];
        let mut norm = T::ZERO;
        for (i, coefficient) in row.iter().enumerate() {
            // A component that is exactly zero by symmetry has no error,
            // whatever its tolerance: not 0/0.
            if *coefficient != T::ZERO {
                let tolerance = self.absolute[i] + self.relative[i] * self.start[i].abs();
                norm = norm.max(coefficient.abs() / tolerance);
            }
        }
        norm
    }

    /// The state at the end of a step of length `step`.
    pub(super) fn make(&mut self, step: T, compensated: bool) {
        let n = self.start.len();
        self.step = step;
        increment(&self.coefficients, n, step, &mut self.end);
        let (start, end) = (&self.start[..n], &mut self.end[..n]);
        if compensated {
            let (residue, rest) = (&self.start_residue[..n], &mut self.end_residue[..n]);
            for i in 0..n {
                (end[i], rest[i]) = two_sum(start[i], end[i] + residue[i]);
            }
        } else {
            for i in 0..n {
                end[i] = start[i] + end[i];
            }
        }
    }

    /// Makes the end of the step the start of the next one.
    pub(super) fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_residue, &mut self.end_residue);
    }
}

/// Σ y\[k\] τᵏ over k ≥ 1 by Horner's rule, for all components side by side.
fn increment<T: Real>(coefficients: &[T], n: usize, tau: T, out: &mut [T]) {
    out.fill(T::ZERO);
    for row in coefficients[n..].chunks_exact(n).rev() {
        for (value, &coefficient) in out.iter_mut().zip(row) {
            *value = (*value + coefficient) * tau;
        }
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
        let n = self.start.len();
        increment(&self.coefficients, n, fraction * self.step, out);
        for (value, &start) in out.iter_mut().zip(&self.start) {
            *value += start;
        }
    }
}
