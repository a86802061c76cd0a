//! The vectors that a run of the method works on, allocated once.

use alloc::vec;
use alloc::vec::Vec;

use super::tables::STAGES_DENSE;
use crate::integrate::options::Options;
use crate::scalar::Real;

/// Workspace for a state of fixed dimension.
#[derive(Clone, Debug)]
pub(super) struct Memory<T> {
    /// Relative tolerance of each component.
    pub(super) relative: Vec<T>,
    /// Absolute tolerance of each component.
    pub(super) absolute: Vec<T>,
    /// State at the start of the step.
    pub(super) start: Vec<T>,
    /// State at the end of the step.
    pub(super) end: Vec<T>,
    /// State at which a stage is evaluated.
    pub(super) stage: Vec<T>,
    /// Rates of the stages; `rates[j - 1]` belongs to stage j.
    pub(super) rates: [Vec<T>; STAGES_DENSE],
    /// Rounding error of `start`, to be added to it: zero unless the sums are
    /// compensated.
    pub(super) start_residue: Vec<T>,
    /// Rounding error of `end`.
    pub(super) end_residue: Vec<T>,
    /// Coefficients of the dense output beyond the start value.
    pub(super) dense: [Vec<T>; 7],
}

impl<T: Real> Memory<T> {
    pub(super) fn new(options: &Options<T>, start: &[T]) -> Self {
        let n = start.len();
        let zeros = || vec![T::ZERO; n];
        Self {
            relative: options.relative.expand(n),
            absolute: options.absolute.expand(n),
            start: start.to_vec(),
            end: zeros(),
            stage: zeros(),
            rates: core::array::from_fn(|_| zeros()),
            start_residue: zeros(),
            end_residue: zeros(),
            dense: core::array::from_fn(|_| zeros()),
        }
    }

    /// Makes the end of the accepted step the start of the next one. The rates
    /// at the end become its first stage (FSAL).
    pub(super) fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_residue, &mut self.end_residue);
        self.rates.swap(0, 12);
    }
}
