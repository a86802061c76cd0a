//! The arithmetic of one step: stages, error estimate, dense output.

use super::memory::Memory;
use super::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A14, A15, A16, B, B_THIRD, C, D, E_FIFTH, Row,
};
use crate::integrate::request::all_finite;
use crate::scalar::Real;
use crate::system::Ode;

/// Rates were not finite at this time; the state is in [`Memory::stage`].
#[derive(Clone, Copy, Debug)]
pub(super) struct NonFiniteRates<T> {
    pub(super) time: T,
}

/// One step from `time` of length `step` (negative when running backwards).
#[derive(Clone, Copy, Debug)]
pub(super) struct Span<T> {
    pub(super) time: T,
    pub(super) step: T,
}

impl<T: Real> Span<T> {
    fn node(&self, stage: usize) -> T {
        self.time + T::from_f64(C[stage - 1]) * self.step
    }
}

/// Calls `assign(i, sum of row)` for every component i, the sum running over
/// the stages of `row`.
// One index into all slices at once.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
fn for_each_sum<T: Real, const N: usize>(
    row: &Row<N>,
    rates: &[alloc::vec::Vec<T>],
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
    /// Evaluates the rates of `stage` at y + h (sum of row).
    #[inline(always)]
    fn stage<O: Ode<T> + ?Sized, const N: usize>(
        &mut self,
        ode: &O,
        span: Span<T>,
        stage: usize,
        row: &Row<N>,
    ) -> Result<(), NonFiniteRates<T>> {
        let n = self.start.len();
        let (start, values) = (&self.start[..n], &mut self.stage[..n]);
        for_each_sum(row, &self.rates, n, |i, sum| {
            values[i] = start[i] + span.step * sum
        });
        self.evaluate(ode, span.node(stage), stage)
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

    /// Rates at the end of an accepted step, at time `time`: stage 13, which is
    /// stage 1 of the next step.
    pub(super) fn evaluate_end<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        time: T,
    ) -> Result<(), NonFiniteRates<T>> {
        self.stage.copy_from_slice(&self.end);
        self.evaluate(ode, time, 13)
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

    /// Stages 2 to 12, from stage 1 in place.
    pub(super) fn stages<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        self.stage(ode, span, 2, &A2)?;
        self.stage(ode, span, 3, &A3)?;
        self.stage(ode, span, 4, &A4)?;
        self.stage(ode, span, 5, &A5)?;
        self.stage(ode, span, 6, &A6)?;
        self.stage(ode, span, 7, &A7)?;
        self.stage(ode, span, 8, &A8)?;
        self.stage(ode, span, 9, &A9)?;
        self.stage(ode, span, 10, &A10)?;
        self.stage(ode, span, 11, &A11)?;
        self.stage(ode, span, 12, &A12)
    }

    /// y at the end of the step: y + h (sum of b_j k_j).
    pub(super) fn finish(&mut self, span: Span<T>, compensated: bool) {
        let n = self.start.len();
        let (start, end) = (&self.start[..n], &mut self.end[..n]);
        if compensated {
            let (residue, rest) = (&self.start_residue[..n], &mut self.end_residue[..n]);
            for_each_sum(&B, &self.rates, n, |i, sum| {
                let increment = span.step * sum + residue[i];
                // Knuth's two-sum: end + rest = start + increment exactly.
                end[i] = start[i] + increment;
                let part = end[i] - start[i];
                rest[i] = (start[i] - (end[i] - part)) + (increment - part);
            });
        } else {
            for_each_sum(&B, &self.rates, n, |i, sum| {
                end[i] = start[i] + span.step * sum
            });
        }
    }

    /// Scaled error of the step, combined from the estimates of order 5 and 3
    /// (Solving ODEs I, section II.10, eq. (10.17)): one is the largest
    /// allowed. Infinite where the end of the step is not finite.
    pub(super) fn error(&self, span: Span<T>) -> T {
        if !all_finite(&self.end) {
            return T::ONE / T::ZERO;
        }
        let n = self.start.len();
        let (mut fifth, mut third) = (T::ZERO, T::ZERO);
        let scale = |i: usize| {
            let size = self.start[i].abs().max(self.end[i].abs());
            self.absolute[i] + self.relative[i] * size
        };
        for_each_sum(&E_FIFTH, &self.rates, n, |i, sum| {
            let ratio = scaled(sum, scale(i));
            fifth += ratio * ratio;
        });
        for_each_sum(&B_MINUS_THIRD, &self.rates, n, |i, sum| {
            let ratio = scaled(sum, scale(i));
            third += ratio * ratio;
        });
        let mixed = fifth + T::from_f64(0.01) * third;
        if mixed <= T::ZERO {
            return T::ZERO;
        }
        let count = T::from_f64(n as f64);
        span.step.abs() * fifth / (count * mixed).sqrt()
    }

    /// Stages 14 to 16 and the coefficients of the dense output of an accepted
    /// step, whose stage 13 is in place.
    pub(super) fn prepare_dense<O: Ode<T> + ?Sized>(
        &mut self,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        self.stage(ode, span, 14, &A14)?;
        self.stage(ode, span, 15, &A15)?;
        self.stage(ode, span, 16, &A16)?;
        let n = self.start.len();
        let [increment, left, right, high @ ..] = &mut self.dense;
        for i in 0..n {
            increment[i] = self.end[i] - self.start[i];
            left[i] = span.step * self.rates[0][i] - increment[i];
            right[i] = increment[i] - span.step * self.rates[12][i] - left[i];
        }
        for (row, coefficients) in D.iter().zip(high) {
            for_each_sum(row, &self.rates, n, |i, sum| {
                coefficients[i] = span.step * sum
            });
        }
        Ok(())
    }

    /// Evaluates the dense output at the fraction `s` of the step, which is
    /// y + s (Δy + r (d₁ + s (d₂ + r (d₃ + s (d₄ + r (d₅ + s d₆)))))),
    /// r = 1 − s.
    pub(super) fn dense_output(&self, s: T, out: &mut [T]) {
        let r = T::ONE - s;
        let [increment, d1, d2, d3, d4, d5, d6] = &self.dense;
        for (i, out) in out.iter_mut().enumerate() {
            let tail = d3[i] + s * (d4[i] + r * (d5[i] + s * d6[i]));
            *out = self.start[i] + s * (increment[i] + r * (d1[i] + s * (d2[i] + r * tail)));
        }
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

/// Weights of the solution of order 8 minus those of the one of order 3.
const B_MINUS_THIRD: Row<8> = {
    let mut row = B;
    let mut i = 0;
    while i < row.len() {
        let mut j = 0;
        while j < B_THIRD.len() {
            if row[i].0 == B_THIRD[j].0 {
                row[i].1 -= B_THIRD[j].1;
            }
            j += 1;
        }
        i += 1;
    }
    row
};
