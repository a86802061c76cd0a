//! The registers that the trajectories of one thread work on, allocated once.

use alloc::vec;
use alloc::vec::Vec;

use super::pair::LanePair;
use crate::integrate::lanes::registers::{set_lane, smallest_divisor, tolerances};
use crate::integrate::options::Options;
use crate::scalar::register::Register;
use crate::scalar::{Real, Scalar};

/// Stages of the pair that has most.
pub(super) const MOST_STAGES: usize = 21;

/// Workspace for one state in each lane.
pub struct Memory<R> {
    /// Relative tolerance of each component.
    pub(in crate::integrate::explicit) relative: Vec<R>,
    /// Absolute tolerance of each component, not zero.
    pub(in crate::integrate::explicit) absolute: Vec<R>,
    /// A divisor for what may be zero over zero.
    pub(in crate::integrate::explicit) smallest: R,
    /// State at the start of the step.
    pub(in crate::integrate::explicit) start: Vec<R>,
    /// State at the end of the step.
    pub(in crate::integrate::explicit) end: Vec<R>,
    /// State at which a stage is evaluated.
    pub(in crate::integrate::explicit) stage: Vec<R>,
    /// Rates of the stages, one after the other.
    pub(in crate::integrate::explicit) rates: Vec<R>,
    /// Rounding error of `start`, if the sums are compensated.
    pub(in crate::integrate::explicit) start_residue: Vec<R>,
    /// Rounding error of `end`.
    pub(in crate::integrate::explicit) end_residue: Vec<R>,
    /// Zero after a stage, NaN from the first stage on whose rates are not finite.
    pub(in crate::integrate::explicit) checks: [R; MOST_STAGES],
    /// Coefficients of the dense output beyond the start value, one after the
    /// other.
    pub(in crate::integrate::explicit) dense: Vec<R>,
}

impl<R: Register> Memory<R> {
    pub(super) fn new<M: LanePair>(options: &Options<R::Lane>, n: usize) -> Self {
        const { assert!(M::STAGES_DENSE <= MOST_STAGES) }
        let zero = R::from_f64(0.0);
        let smallest = smallest_divisor();
        let (relative, absolute) = tolerances(options, n);
        Self {
            relative,
            absolute,
            smallest: R::splat(smallest),
            start: vec![zero; n],
            end: vec![zero; n],
            stage: vec![zero; n],
            rates: vec![zero; M::STAGES_DENSE * n],
            start_residue: vec![zero; n],
            end_residue: vec![zero; n],
            checks: [zero; MOST_STAGES],
            dense: vec![zero; M::DENSE_TERMS * n],
        }
    }

    /// Puts a state into a lane. Without one the lane gets zeros, of which
    /// sines and cosines are sooner done than of what is not finite.
    pub(super) fn set(&mut self, lane: usize, values: Option<&[R::Lane]>) {
        for i in 0..self.start.len() {
            let value = values.map_or(R::Lane::ZERO, |values| values[i]);
            set_lane(&mut self.start[i], lane, value);
            set_lane(&mut self.start_residue[i], lane, R::Lane::ZERO);
            set_lane(&mut self.rates[i], lane, R::Lane::ZERO);
        }
    }

    /// Makes the end of the step the start of the next one, in the lanes of
    /// `accepted`. The rates there become its first stage. `n` components.
    #[inline(always)]
    pub(super) fn advance<M: LanePair>(&mut self, n: usize, accepted: R::Mask, compensated: bool) {
        let (first, rest) = self.rates.split_at_mut(n);
        let last = &rest[(M::STAGES - 1) * n..][..n];
        let (start, end) = (&mut self.start[..n], &self.end[..n]);
        for i in 0..n {
            start[i] = end[i].choose(start[i], accepted);
            first[i] = last[i].choose(first[i], accepted);
        }
        if compensated {
            let (residue, rest) = (&mut self.start_residue[..n], &self.end_residue[..n]);
            for i in 0..n {
                residue[i] = rest[i].choose(residue[i], accepted);
            }
        }
    }
}

/// Component i of the sum of a row over the stages, for states of `n`
/// components, with products and sums in one operation.
///
/// No closure takes part: those are functions of their own, which the compiler
/// may leave without the instructions of the registers.
#[inline(always)]
pub(in crate::integrate::explicit) fn sum<R: Scalar>(
    row: &[(usize, f64)],
    rates: &[R],
    n: usize,
    i: usize,
) -> R {
    let mut terms = row.iter();
    let Some(&(stage, factor)) = terms.next() else {
        return R::from_f64(0.0);
    };
    let mut sum = R::from_f64(factor) * rates[(stage - 1) * n + i];
    for &(stage, factor) in terms {
        sum = R::from_f64(factor).mul_add(rates[(stage - 1) * n + i], sum);
    }
    sum
}
