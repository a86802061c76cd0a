//! Verner's pair of order 9(8).

mod tables;

use self::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16, A18, A19, A20, A21, B,
    B_EIGHTH, C, D,
};
use super::pair::{DenseForm, EmbeddedPair, TableRow, difference};
use super::stages::{ErrorScale, StepStages};
use crate::integrate::control::ControlConstants;
use crate::scalar::Scalar;

/// The pair of [`Verner98`](super::Verner98).
#[derive(Clone, Copy, Debug)]
pub struct Verner9;

impl EmbeddedPair for Verner9 {
    const CONTROL: ControlConstants = ControlConstants {
        order: tables::ORDER,
        safety: 0.8,
        smallest_factor: 1.0 / 3.0,
        largest_factor: 6.0,
        beta_share: 0.2,
    };
    const STAGES: usize = tables::STAGES;
    const NODES: &'static [f64] = &C;
    const ROWS: &'static [&'static [(usize, f64)]] = &[
        &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &A12, &A13, &A14, &A15, &A16, &B, &A18,
        &A19, &A20, &A21,
    ];
    const DENSE: DenseForm = DenseForm::Bernstein(&[&D[0], &D[1], &D[2], &D[3], &D[4]]);
    const ERROR_USES_END: bool = false;

    #[inline(always)]
    fn error<W: Scalar, S: ErrorScale<W>>(stages: &StepStages<W>, system: &S, size: W) -> W {
        stages.mean_square_error(system, &B_MINUS_EIGHTH, size)
    }
}

/// Weights of the solution of order 9 minus those of the solution of order 8.
const B_MINUS_EIGHTH: TableRow<10> = difference(&B, &B_EIGHTH);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::explicit::order_conditions::{
        ButcherTable, continuous, order, stage_values,
    };
    use crate::integrate::piece::bernstein;

    #[test]
    fn rows_sum_to_their_nodes() {
        ButcherTable::of::<Verner9>().assert_row_sums();
    }

    #[test]
    fn both_formulas_have_their_orders_and_no_more() {
        let values = stage_values(&ButcherTable::of::<Verner9>(), 10);
        assert_eq!(order(&values, &B), 9);
        assert_eq!(order(&values, &B_EIGHTH), 8);
    }

    #[test]
    fn the_dense_output_has_order_eight_everywhere() {
        let values = stage_values(&ButcherTable::of::<Verner9>(), 8);
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
