//! The registers that the trajectories of one thread work on, allocated once.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::explicit::dop853::tables::STAGES;
use crate::integrate::options::Options;
use crate::scalar::register::Register;
use crate::scalar::{Real, Scalar};
use crate::system::State;

/// Numbers in the widest register.
pub(super) const WIDEST: usize = 16;

/// One number a lane; those beyond the last lane mean nothing.
pub(super) type Numbers<T> = [T; WIDEST];

/// Workspace for one state in each lane.
pub(super) struct Memory<R> {
    /// Relative tolerance of each component.
    pub(super) relative: Vec<R>,
    /// Absolute tolerance of each component, not zero.
    pub(super) absolute: Vec<R>,
    /// A divisor for what may be zero over zero.
    pub(super) smallest: R,
    /// State at the start of the step.
    pub(super) start: Vec<R>,
    /// State at the end of the step.
    pub(super) end: Vec<R>,
    /// State at which a stage is evaluated.
    pub(super) stage: Vec<R>,
    /// Rates of the stages, one after the other.
    pub(super) rates: Vec<R>,
    /// Rounding error of `start`, if the sums are compensated.
    pub(super) start_residue: Vec<R>,
    /// Rounding error of `end`.
    pub(super) end_residue: Vec<R>,
    /// Zero after a stage, NaN from the first stage on whose rates are not finite.
    pub(super) checks: [R; STAGES + 1],
}

impl<R: Register> Memory<R> {
    pub(super) fn new(options: &Options<R::Lane>, n: usize) -> Self {
        const { assert!(R::LANES <= WIDEST) }
        let zero = R::from_f64(0.0);
        let smallest = smallest_divisor();
        Self {
            relative: options
                .relative
                .expand(n)
                .into_iter()
                .map(R::splat)
                .collect(),
            // Where a component is exactly zero by symmetry, its error is too:
            // zero over the smallest number, not over zero.
            absolute: options
                .absolute
                .expand(n)
                .into_iter()
                .map(|absolute| R::splat(absolute.max(smallest)))
                .collect(),
            smallest: R::splat(smallest),
            start: vec![zero; n],
            end: vec![zero; n],
            stage: vec![zero; n],
            rates: vec![zero; (STAGES + 1) * n],
            start_residue: vec![zero; n],
            end_residue: vec![zero; n],
            checks: [zero; STAGES + 1],
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

    /// The state at the start of the step in a lane.
    pub(super) fn state(&self, lane: usize, time: R::Lane) -> State<R::Lane> {
        State {
            time,
            values: numbers_in(&self.start, lane),
        }
    }

    /// Makes the end of the step the start of the next one, in the lanes of
    /// `accepted`. The rates there become its first stage. `n` components.
    #[inline(always)]
    pub(super) fn advance(&mut self, n: usize, accepted: R::Mask, compensated: bool) {
        let (first, rest) = self.rates.split_at_mut(n);
        let last = &rest[(STAGES - 1) * n..][..n];
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

/// The numbers of a register.
#[inline(always)]
pub(super) fn numbers<R: Register>(register: R) -> Numbers<R::Lane> {
    let mut numbers = [R::Lane::ZERO; WIDEST];
    register.store(&mut numbers);
    numbers
}

/// The register of these numbers.
#[inline(always)]
pub(super) fn register<R: Register>(numbers: &Numbers<R::Lane>) -> R {
    match R::load(numbers) {
        Some(register) => register,
        // No register is wider: asserted in `Memory::new`.
        None => R::from_f64(f64::NAN),
    }
}

/// The numbers that these registers have in a lane.
pub(super) fn numbers_in<R: Register>(registers: &[R], lane: usize) -> Vec<R::Lane> {
    registers.iter().map(|&r| numbers(r)[lane]).collect()
}

fn set_lane<R: Register>(target: &mut R, lane: usize, value: R::Lane) {
    let mut changed = numbers(*target);
    changed[lane] = value;
    *target = register(&changed);
}

/// The smallest power of two whose inverse is finite.
fn smallest_divisor<T: Real>() -> T {
    let half = T::from_f64(0.5);
    let mut smallest = T::ONE;
    while (T::ONE / (smallest * half)).is_finite() {
        smallest = smallest * half;
    }
    smallest
}

/// Component i of the sum of a row over the stages, for states of `n`
/// components, with products and sums in one operation.
///
/// No closure takes part: those are functions of their own, which the compiler
/// may leave without the instructions of the registers.
#[inline(always)]
pub(super) fn sum<R: Scalar>(row: &[(usize, f64)], rates: &[R], n: usize, i: usize) -> R {
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
