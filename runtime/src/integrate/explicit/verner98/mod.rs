//! Verner's pair of order 9(8).

#[cfg(feature = "std")]
mod lanes;
mod tables;

use self::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16, A18, A19, A20, A21, B,
    B_EIGHTH, C, D, DEGREE,
};
use super::arithmetic::{NonFiniteRates, Row, Span, for_each_sum};
use super::memory::Memory;
use super::pair::Pair;
use crate::integrate::control::ControlConstants;
use crate::scalar::{Real, Scalar};
use crate::system::Ode;

/// The pair of [`Verner98`](super::Verner98).
#[derive(Clone, Copy, Debug)]
pub struct Verner9;

impl Pair for Verner9 {
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
    const DENSE_TERMS: usize = tables::DEGREE;
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
        memory.stage(ode, span, (12, C[11]), &A12)?;
        memory.stage(ode, span, (13, C[12]), &A13)?;
        memory.stage(ode, span, (14, C[13]), &A14)?;
        memory.stage(ode, span, (15, C[14]), &A15)?;
        memory.stage(ode, span, (16, C[15]), &A16)
    }

    fn finish<T: Real>(memory: &mut Memory<T>, span: Span<T>, compensated: bool) {
        memory.finish(span, &B, compensated);
    }

    fn error<T: Real>(memory: &Memory<T>, span: Span<T>) -> T {
        memory.mean_square_error(span, &B_MINUS_EIGHTH)
    }

    fn prepare_dense<T: Real, O: Ode<T> + ?Sized>(
        memory: &mut Memory<T>,
        ode: &O,
        span: Span<T>,
    ) -> Result<(), NonFiniteRates<T>> {
        memory.stage(ode, span, (18, C[17]), &A18)?;
        memory.stage(ode, span, (19, C[18]), &A19)?;
        memory.stage(ode, span, (20, C[19]), &A20)?;
        memory.stage(ode, span, (21, C[20]), &A21)?;
        let Memory {
            start,
            end,
            rates,
            dense,
            ..
        } = memory;
        if let [first, inner @ .., before_last, last] = dense.as_mut_slice() {
            let part = span.step / T::from_f64(DEGREE as f64);
            for i in 0..start.len() {
                first[i] = part * rates[0][i];
                last[i] = end[i] - start[i];
                before_last[i] = last[i] - part * rates[16][i];
            }
            for (row, coefficients) in D.iter().zip(inner) {
                for_each_sum(row, rates, start.len(), |i, sum| {
                    coefficients[i] = span.step * sum
                });
            }
        }
        Ok(())
    }

    /// y + Σ_k d_k (8 over k) s^k r^(8 − k), r = 1 − s.
    fn dense_output<T: Real>(memory: &Memory<T>, s: T, out: &mut [T]) {
        let weights = bernstein(s);
        for (i, out) in out.iter_mut().enumerate() {
            let both = memory.dense.iter().zip(weights);
            let sum = both.fold(T::ZERO, |sum, (term, weight)| sum + weight * term[i]);
            *out = memory.start[i] + sum;
        }
    }
}

/// Bernstein polynomials 1 to 8 of degree 8.
#[inline(always)]
fn bernstein<T: Scalar>(s: T) -> [T; DEGREE] {
    let [zero, one] = [0.0, 1.0].map(T::from_f64);
    let r = one - s;
    let mut row = [zero; DEGREE + 1];
    row[0] = one;
    for degree in 1..=DEGREE {
        for k in (1..=degree).rev() {
            row[k] = r * row[k] + s * row[k - 1];
        }
        row[0] = r * row[0];
    }
    let mut inner = [zero; DEGREE];
    inner.copy_from_slice(&row[1..]);
    inner
}

/// Weights of the solution of order 9 minus those of the one of order 8.
const B_MINUS_EIGHTH: Row<10> = {
    let mut row = [(16, 0.0); 10];
    let mut i = 0;
    while i < B.len() {
        row[i] = B[i];
        i += 1;
    }
    i = 0;
    while i < row.len() {
        let mut j = 0;
        while j < B_EIGHTH.len() {
            if row[i].0 == B_EIGHTH[j].0 {
                row[i].1 -= B_EIGHTH[j].1;
            }
            j += 1;
        }
        i += 1;
    }
    row
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::explicit::order_conditions::{Table, continuous, order, stage_values};

    fn table() -> Table {
        let rows: [&[(usize, f64)]; tables::STAGES_DENSE] = [
            &[],
            &A2,
            &A3,
            &A4,
            &A5,
            &A6,
            &A7,
            &A8,
            &A9,
            &A10,
            &A11,
            &A12,
            &A13,
            &A14,
            &A15,
            &A16,
            &B,
            &A18,
            &A19,
            &A20,
            &A21,
        ];
        Table {
            nodes: C.to_vec(),
            rows: rows.to_vec(),
        }
    }

    #[test]
    fn rows_sum_to_their_nodes() {
        table().assert_row_sums();
    }

    #[test]
    fn both_formulas_have_their_orders_and_no_more() {
        let values = stage_values(&table(), 10);
        assert_eq!(order(&values, &B), 9);
        assert_eq!(order(&values, &B_EIGHTH), 8);
    }

    #[test]
    fn the_dense_output_has_order_eight_everywhere() {
        let values = stage_values(&table(), 8);
        continuous(&values, 8, |s, weights| {
            let powers = bernstein(s);
            weights.add(1, powers[0] / 8.0);
            for (row, power) in D.iter().zip(&powers[1..]) {
                for &(stage, weight) in row {
                    weights.add(stage, weight * power);
                }
            }
            for &(stage, weight) in &B {
                weights.add(stage, weight * (powers[6] + powers[7]));
            }
            weights.add(17, -powers[6] / 8.0);
        });
    }
}
