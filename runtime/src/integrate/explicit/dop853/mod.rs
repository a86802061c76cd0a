//! Dormand and Prince's pair of order 8(5,3).

mod tables;

use self::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A14, A15, A16, B, B_THIRD, C, D, E_FIFTH,
};
use super::pair::{DenseForm, EmbeddedPair, TableRow, difference};
use super::stages::{ErrorScale, StepStages, count};
use crate::integrate::control::ControlConstants;
use crate::scalar::Scalar;

/// The pair of [`Dop853`](super::Dop853).
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince8;

impl EmbeddedPair for DormandPrince8 {
    /// Constants of the authors' program, except for the safety factor (0.9 there). With 0.8 the
    /// paper's pendulum in regular motion takes the same number of evaluations, has fewer rejected
    /// steps and half the error, at tolerances from 1e-7 to 1e-13.
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
        &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &A12, &B, &A14, &A15, &A16,
    ];
    const DENSE: DenseForm = DenseForm::Alternating(&[&D[0], &D[1], &D[2], &D[3]]);
    const ERROR_USES_END: bool = false;

    /// Returns the scaled error of a step, from the estimates of orders 5 and 3 (Solving ODEs I,
    /// section II.10, eq. (10.17)).
    #[inline(always)]
    fn error<W: Scalar, S: ErrorScale<W>>(stages: &StepStages<W>, system: &S, size: W) -> W {
        let [fifth, third] = stages.squares(system, [&E_FIFTH, &B_MINUS_THIRD]);
        let mixed = W::from_f64(0.01).mul_add(third, fifth);
        let [error] = system.scaled([size * fifth], (count(system) * mixed).sqrt());
        error
    }
}

/// Weights of the solution of order 8 minus those of the solution of order 3.
const B_MINUS_THIRD: TableRow<8> = difference(&B, &B_THIRD);
