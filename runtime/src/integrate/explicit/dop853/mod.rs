//! Dormand and Prince's pair of order 8(5,3).

#[cfg(feature = "std")]
mod lanes;
mod tables;

use self::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A14, A15, A16, B, B_THIRD, C, D, E_FIFTH,
};
use super::arithmetic::{NonFiniteRates, Row, Span, for_each_sum};
use super::memory::Memory;
use super::pair::Pair;
use crate::integrate::control::ControlConstants;
use crate::scalar::Real;
use crate::system::Ode;

/// The pair of [`Dop853`](super::Dop853).
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince8;

impl Pair for DormandPrince8 {
    /// As in the authors' program, but for the safety factor, which is 0.9
    /// there. With 0.8 the paper's pendulum in regular motion takes as many
    /// evaluations, has fewer steps rejected and ends with half the error, at
    /// tolerances from 1e-7 to 1e-13.
    const CONTROL: ControlConstants = ControlConstants {
        order: tables::ORDER,
        safety: 0.8,
        smallest_factor: 1.0 / 3.0,
        largest_factor: 6.0,
        beta_share: 0.2,
    };
    const ORDER: u32 = tables::ORDER;
    const STAGES: usize = tables::STAGES;
    const STAGES_DENSE: usize = tables::STAGES_DENSE;
    const DENSE_TERMS: usize = 7;
    const ERROR_USES_END: bool = false;

    fn stages<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        memory.stage(ode, span, (2, C[1]), &A2)?;
        memory.stage(ode, span, (3, C[2]), &A3)?;
        memory.stage(ode, span, (4, C[3]), &A4)?;
        memory.stage(ode, span, (5, C[4]), &A5)?;
        memory.stage(ode, span, (6, C[5]), &A6)?;
        memory.stage(ode, span, (7, C[6]), &A7)?;
        memory.stage(ode, span, (8, C[7]), &A8)?;
        memory.stage(ode, span, (9, C[8]), &A9)?;
        memory.stage(ode, span, (10, C[9]), &A10)?;
        memory.stage(ode, span, (11, C[10]), &A11)?;
        memory.stage(ode, span, (12, C[11]), &A12)
    }

    fn finish<T: Real>(memory: &mut Memory<T>, span: Span<T>, compensated: bool) {
        memory.finish(span, &B, compensated);
    }

    /// Combined from the estimates of order 5 and 3 (Solving ODEs I, section
    /// II.10, eq. (10.17)).
    fn error<T: Real>(memory: &Memory<T>, span: Span<T>) -> T {
        let fifth = memory.squares(&E_FIFTH);
        let third = memory.squares(&B_MINUS_THIRD);
        let mixed = fifth + T::from_f64(0.01) * third;
        if mixed <= T::ZERO {
            return T::ZERO;
        }
        let count = T::from_f64(memory.start.len() as f64);
        span.step.abs() * fifth / (count * mixed).sqrt()
    }

    fn prepare_dense<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        memory.stage(ode, span, (14, C[13]), &A14)?;
        memory.stage(ode, span, (15, C[14]), &A15)?;
        memory.stage(ode, span, (16, C[15]), &A16)?;
        let Memory {
            start,
            end,
            rates,
            dense,
            ..
        } = memory;
        if let [increment, left, right, high @ ..] = dense.as_mut_slice() {
            for i in 0..start.len() {
                increment[i] = end[i] - start[i];
                left[i] = span.step * rates[0][i] - increment[i];
                right[i] = increment[i] - span.step * rates[12][i] - left[i];
            }
            for (row, coefficients) in D.iter().zip(high) {
                for_each_sum(row, rates, start.len(), |i, sum| {
                    coefficients[i] = span.step * sum
                });
            }
        }
        Ok(())
    }

    /// y + s (Δy + r (d₁ + s (d₂ + r (d₃ + s (d₄ + r (d₅ + s d₆)))))), r = 1 − s.
    fn dense_output<T: Real>(memory: &Memory<T>, s: T, out: &mut [T]) {
        let r = T::ONE - s;
        if let [increment, d1, d2, d3, d4, d5, d6] = memory.dense.as_slice() {
            for (i, out) in out.iter_mut().enumerate() {
                let tail = d3[i] + s * (d4[i] + r * (d5[i] + s * d6[i]));
                *out = memory.start[i] + s * (increment[i] + r * (d1[i] + s * (d2[i] + r * tail)));
            }
        }
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
