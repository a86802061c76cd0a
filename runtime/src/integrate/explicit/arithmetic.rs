//! Arithmetic that all explicit methods share: stages, sums, scaled norms.

use alloc::vec::Vec;

use super::memory::Memory;
use crate::integrate::request::all_finite;
use crate::integrate::sum::two_sum;
use crate::scalar::Real;
use crate::system::Ode;

/// One row of a table: the number of a stage, from 1, and its coefficient.
pub(crate) type Row<const N: usize> = [(usize, f64); N];

/// Rates were not finite at this time; the state is in [`Memory::stage`].
#[derive(Clone, Copy, Debug)]
pub struct NonFiniteRates<T> {
    pub(crate) time: T,
}

/// One step from `time` of length `step` (negative when running backwards).
#[derive(Clone, Copy, Debug)]
pub struct Span<T> {
    pub(crate) time: T,
    pub(crate) step: T,
}

impl<T: Real> Span<T> {
    /// Time at the fraction `node` of the step.
    pub(crate) fn node(&self, node: f64) -> T {
        self.time + T::from_f64(node) * self.step
    }
}

/// Calls `assign(i, sum of row)` for every component i, the sum running over
/// the stages of `row`.
// One index into all slices at once.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub(super) fn for_each_sum<T: Real, const N: usize>(
    row: &Row<N>,
    rates: &[Vec<T>],
    n: usize,
    mut assign: impl FnMut(usize, T),
) {
    // Slices of one known length: no bounds check is left inside the loop.
    let stages: [&[T]; N] = row.map(|(stage, _)| &rates[stage - 1][..n]);
    for i in 0..n {
        let mut sum = T::from_f64(row[0].1) * stages[0][i];
        for j in 1..N {
            sum += T::from_f64(row[j].1) * stages[j][i];
        }
        assign(i, sum);
    }
}

impl<T: Real> Memory<T> {
    /// Evaluates the rates of `stage`, whose node is `node`, at
    /// y + h (sum of row).
    #[inline(always)]
    pub(super) fn stage<O: Ode<T> + ?Sized, const N: usize>(
        &mut self,
        ode: &O,
        span: Span<T>,
        (stage, node): (usize, f64),
        row: &Row<N>,
    ) -> Result<(), NonFiniteRates<T>> {
        let n = self.start.len();
        let (start, values) = (&self.start[..n], &mut self.stage[..n]);
        for_each_sum(row, &self.rates, n, |i, sum| {
            values[i] = start[i] + span.step * sum
        });
        self.evaluate(ode, span.node(node), stage)
    }

    fn evaluate<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        time: T,
        stage: usize,
    ) -> Result<(), NonFiniteRates<T>> {
        let rates = &mut self.rates[stage - 1];
        ode.rates(time, &self.stage, rates);
        if all_finite(rates) {
            Ok(())
        } else {
            Err(NonFiniteRates { time })
        }
    }

    /// Rates at the start of the first step: stage 1.
    pub(super) fn evaluate_start<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        time: T,
    ) -> Result<(), NonFiniteRates<T>> {
        self.stage.copy_from_slice(&self.start);
        self.evaluate(ode, time, 1)
    }

    /// Rates at the end of the step, at time `time`: stage `stage`, which is
    /// stage 1 of the next step.
    pub(super) fn evaluate_end<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        time: T,
        stage: usize,
    ) -> Result<(), NonFiniteRates<T>> {
        self.stage.copy_from_slice(&self.end);
        self.evaluate(ode, time, stage)
    }

    /// Rates after an Euler step, into the place of stage 2; returns the norm
    /// of their change, scaled by the tolerances at the start.
    pub(super) fn euler_change<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        span: Span<T>,
    ) -> Result<T, NonFiniteRates<T>> {
        for ((value, &start), &rate) in self.stage.iter_mut().zip(&self.start).zip(&self.rates[0]) {
            *value = start + span.step * rate;
        }
        self.evaluate(ode, span.time + span.step, 2)?;
        Ok(self.scaled_norm(|memory, i| memory.rates[1][i] - memory.rates[0][i]))
    }

    /// Euclidean norm of a vector whose components are divided by their
    /// tolerances at the start of the step.
    pub(super) fn scaled_norm(&self, component: impl Fn(&Self, usize) -> T) -> T {
        let mut sum = T::ZERO;
        for i in 0..self.start.len() {
            let scale = self.absolute[i] + self.relative[i] * self.start[i].abs();
            let ratio = scaled(component(self, i), scale);
            sum += ratio * ratio;
        }
        sum.sqrt()
    }

    /// y at the end of the step: y + h (sum of row).
    #[inline(always)]
    pub(super) fn finish<const N: usize>(
        &mut self,
        span: Span<T>,
        row: &Row<N>,
        compensated: bool,
    ) {
        let n = self.start.len();
        let (start, end) = (&self.start[..n], &mut self.end[..n]);
        if compensated {
            let (residue, rest) = (&self.start_residue[..n], &mut self.end_residue[..n]);
            for_each_sum(row, &self.rates, n, |i, sum| {
                (end[i], rest[i]) = two_sum(start[i], span.step * sum + residue[i]);
            });
        } else {
            for_each_sum(row, &self.rates, n, |i, sum| {
                end[i] = start[i] + span.step * sum
            });
        }
    }

    /// Tolerance of component i for an error of the step.
    #[inline(always)]
    pub(super) fn scale(&self, i: usize) -> T {
        let size = self.start[i].abs().max(self.end[i].abs());
        self.absolute[i] + self.relative[i] * size
    }

    /// Sum over the components of the squares of (sum of row)/tolerance.
    #[inline(always)]
    pub(super) fn squares<const N: usize>(&self, row: &Row<N>) -> T {
        let mut sum_of_squares = T::ZERO;
        for_each_sum(row, &self.rates, self.start.len(), |i, sum| {
            let ratio = scaled(sum, self.scale(i));
            sum_of_squares += ratio * ratio;
        });
        sum_of_squares
    }

    /// Scaled error of a step with one estimate h (sum of row): its root mean
    /// square over the components (Solving ODEs I, section II.4, eq. (4.11)).
    #[inline(always)]
    pub(super) fn mean_square_error<const N: usize>(&self, span: Span<T>, row: &Row<N>) -> T {
        let count = T::from_f64(self.start.len() as f64);
        span.step.abs() * (self.squares(row) / count).sqrt()
    }
}

/// Value over tolerance. A component that is exactly zero by symmetry has no
/// error, whatever its tolerance: not 0/0.
#[inline(always)]
fn scaled<T: Real>(value: T, scale: T) -> T {
    if value == T::ZERO {
        T::ZERO
    } else {
        value / scale
    }
}
