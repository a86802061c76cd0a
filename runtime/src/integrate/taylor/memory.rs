//! The vectors that a run works on, allocated once, and what is done with them.

use alloc::vec;
use alloc::vec::Vec;

use super::root::least_inverse_root;
use crate::integrate::dense::{DenseError, Interpolant};
use crate::integrate::options::Options;
use crate::integrate::request::all_finite;
use crate::integrate::sum::two_sum;
use crate::scalar::Real;
use crate::taylor::Quad;

/// Workspace for a state of fixed dimension and polynomials of fixed order.
#[derive(Clone, Debug)]
pub(super) struct Memory<T> {
    relative: Vec<T>,
    absolute: Vec<T>,
    order: usize,
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
        let last_two = &self.coefficients[(self.order - 1) * n..][..2 * n];
        let (before, last) = last_two.split_at(n);
        let mut norms = [T::ZERO; 2];
        for i in 0..n {
            let tolerance = self.absolute[i] + self.relative[i] * self.start[i].abs();
            for (norm, &coefficient) in norms.iter_mut().zip([&before[i], &last[i]]) {
                // A component that is exactly zero by symmetry has no error,
                // whatever its tolerance: not 0/0.
                if coefficient != T::ZERO {
                    *norm = norm.max(coefficient.abs() / tolerance);
                }
            }
        }
        let [before, last] = norms.map(T::to_f64);
        let step = least_inverse_root([(before, self.order - 1), (last, self.order)]);
        self.safety * T::from_f64(step)
    }

    /// Whether the last two terms are finite.
    pub(super) fn has_finite_end(&self) -> bool {
        let n = self.start.len();
        all_finite(&self.coefficients[(self.order - 1) * n..])
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

/// Σ y\[k\] τᵏ over k ≥ 1, by Horner's rule in τ² for odd and even k apart.
fn increment<T: Real>(coefficients: &[T], n: usize, tau: T, out: &mut [T]) {
    // Four components side by side, what is left over in pairs.
    let (fours, rest) = out.as_chunks_mut::<4>();
    let mut first = 0;
    for block in fours {
        increment_block(coefficients, n, first, tau, block);
        first += 4;
    }
    let (pairs, rest) = rest.as_chunks_mut::<2>();
    for block in pairs {
        increment_block(coefficients, n, first, tau, block);
        first += 2;
    }
    for value in rest {
        increment_block(coefficients, n, first, tau, core::array::from_mut(value));
        first += 1;
    }
}

/// The components from number `first` on.
#[inline(always)]
fn increment_block<T: Real, const W: usize>(
    coefficients: &[T],
    n: usize,
    first: usize,
    tau: T,
    out: &mut [T; W],
) {
    let square = tau * tau;
    let (mut odd, mut even) = ([T::ZERO; W], [T::ZERO; W]);
    let component = |row: &[T]| -> [T; W] {
        row.get(first..)
            .and_then(<[T]>::first_chunk)
            .copied()
            .unwrap_or([T::NAN; W])
    };
    let rows = &coefficients[n..];
    let order = rows.len() / n;
    // Pairs of an odd and an even order; the highest odd one may be alone.
    let (pairs, alone) = rows.split_at((order - order % 2) * n);
    if !alone.is_empty() {
        odd = component(alone);
    }
    for pair in pairs.chunks_exact(2 * n).rev() {
        let (lower, upper) = pair.split_at(n);
        let (lower, upper) = (component(lower), component(upper));
        for i in 0..W {
            odd[i] = odd[i] * square + lower[i];
            even[i] = even[i] * square + upper[i];
        }
    }
    for i in 0..W {
        out[i] = (odd[i] + even[i] * tau) * tau;
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
