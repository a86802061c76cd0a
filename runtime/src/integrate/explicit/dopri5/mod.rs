//! Dormand and Prince's pair of order 5(4).

mod tables;

use self::tables::{A2, A3, A4, A5, A6, B, C, D, E};
use super::pair::{DenseForm, EmbeddedPair};
use super::stages::{ErrorScale, StepStages};
use crate::integrate::control::ControlConstants;
use crate::scalar::Scalar;

/// The pair of [`Dopri5`](super::Dopri5).
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince5;

/// Factor on the error estimate. The estimate is the error of the formula of order 4, which is much
/// larger than the actual error of one step, but the errors of many steps add up: over ten seconds
/// to some 160 times the tolerance, whereas the pairs of orders 8 and 9 stay near the tolerance.
/// With this factor the three pairs have similar errors at equal tolerance.
const ESTIMATE_WEIGHT: f64 = 20.0;

impl EmbeddedPair for DormandPrince5 {
    /// Constants of the authors' program; only the error estimate is weighted differently.
    const CONTROL: ControlConstants = ControlConstants {
        order: tables::ORDER,
        safety: 0.9,
        smallest_factor: 0.2,
        largest_factor: 10.0,
        beta_share: 0.75,
    };
    const STAGES: usize = tables::STAGES;
    const NODES: &'static [f64] = &C;
    const ROWS: &'static [&'static [(usize, f64)]] = &[&A2, &A3, &A4, &A5, &A6, &B];
    const DENSE: DenseForm = DenseForm::Alternating(&[&D]);
    const ERROR_USES_END: bool = true;

    #[inline(always)]
    fn error<W: Scalar, S: ErrorScale<W>>(stages: &StepStages<W>, system: &S, size: W) -> W {
        W::from_f64(ESTIMATE_WEIGHT) * stages.mean_square_error(system, &E, size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::explicit::order_conditions::{
        ButcherTable, continuous, order, stage_values,
    };

    #[test]
    fn rows_sum_to_their_nodes() {
        ButcherTable::of::<DormandPrince5>().assert_row_sums();
    }

    #[test]
    fn both_formulas_have_their_orders_and_no_more() {
        let values = stage_values(&ButcherTable::of::<DormandPrince5>(), 6);
        assert_eq!(order(&values, &B), 5);
        let mut embedded = E.map(|(stage, weight)| (stage, -weight));
        for entry in &mut embedded {
            let own = B.iter().find(|own| own.0 == entry.0);
            entry.1 += own.map_or(0.0, |own| own.1);
        }
        assert_eq!(order(&values, &embedded), 4);
    }

    #[test]
    fn the_dense_output_has_order_four_everywhere() {
        let values = stage_values(&ButcherTable::of::<DormandPrince5>(), 4);
        continuous(&values, 4, |s, weights| {
            let r = 1.0 - s;
            for &(stage, weight) in &B {
                // Coefficient of Δy in d₁ = h k₁ − Δy and d₂ = Δy − h k₇ − d₁.
                weights.add(stage, weight * (s - s * r + 2.0 * s * s * r));
            }
            weights.add(1, s * r - s * s * r);
            weights.add(7, -(s * s * r));
            for &(stage, weight) in &D {
                weights.add(stage, weight * s * s * r * r);
            }
        });
    }
}
