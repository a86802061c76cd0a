//! The vectors that a run of a method works on, allocated once.

use alloc::vec;
use alloc::vec::Vec;

use super::pair::Pair;
use crate::integrate::options::Options;
use crate::scalar::Real;

/// Workspace for a state of fixed dimension.
#[derive(Clone, Debug)]
pub struct Memory<T> {
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
    pub(super) rates: Vec<Vec<T>>,
    /// Rounding error of `start`, to be added to it: zero unless the sums are
    /// compensated.
    pub(super) start_residue: Vec<T>,
    /// Rounding error of `end`.
    pub(super) end_residue: Vec<T>,
    /// Coefficients of the dense output beyond the start value.
    pub(super) dense: Vec<Vec<T>>,
}

impl<T: Real> Memory<T> {
    /// Workspace of the pair `M`.
    pub(super) fn new<M: Pair>(options: &Options<T>, start: &[T]) -> Self {
        let n = start.len();
        Self {
            relative: options.relative.expand(n),
            absolute: options.absolute.expand(n),
            start: start.to_vec(),
            end: vec![T::ZERO; n],
            stage: vec![T::ZERO; n],
            rates: vec![vec![T::ZERO; n]; M::STAGES_DENSE],
            start_residue: vec![T::ZERO; n],
            end_residue: vec![T::ZERO; n],
            dense: vec![vec![T::ZERO; n]; M::DENSE_TERMS],
        }
    }

    /// Makes the end of the accepted step the start of the next one. The rates
    /// at the end, which are stage `end_stage`, become its first stage.
    pub(super) fn advance(&mut self, end_stage: usize) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_residue, &mut self.end_residue);
        self.rates.swap(0, end_stage - 1);
    }
}
