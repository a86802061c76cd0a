//! The pair of order 8(5,3) in lanes.

use super::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A14, A15, A16, B, C, D, E_FIFTH, STAGES_DENSE,
};
use super::{B_MINUS_THIRD, DormandPrince8};
use crate::integrate::explicit::Span;
use crate::integrate::explicit::lanes::{LanePair, Memory, make_stages, sum};
use crate::integrate::lanes::Models;
use crate::scalar::register::Register;
use crate::system::Cast;

impl LanePair for DormandPrince8 {
    const NODES: &'static [f64] = &C;
    const ROWS: &'static [&'static [(usize, f64)]] = &[
        &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &A12, &B, &A14, &A15, &A16,
    ];

    #[inline(always)]
    fn stages_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    ) {
        make_stages!(memory, models, span: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12);
    }

    /// As in the plain method (Solving ODEs I, section II.10, eq. (10.17)).
    #[inline(always)]
    fn errors<R: Register>(memory: &Memory<R>, n: usize, size: R) -> R {
        let rates = &memory.rates[..STAGES_DENSE * n];
        let (mut fifth, mut third) = (R::from_f64(0.0), R::from_f64(0.0));
        for i in 0..n {
            let inverse = memory.inverse_scale(i);
            let ratio = sum(&E_FIFTH, rates, n, i) * inverse;
            fifth = ratio.mul_add(ratio, fifth);
            let ratio = sum(&B_MINUS_THIRD, rates, n, i) * inverse;
            third = ratio.mul_add(ratio, third);
        }
        let mixed = R::from_f64(0.01).mul_add(third, fifth);
        // No error at all: zero over any number.
        let mixed = mixed.larger_size(memory.smallest);
        size * fifth / (R::from_f64(n as f64) * mixed).sqrt()
    }

    #[inline(always)]
    fn prepare_dense_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    ) {
        make_stages!(memory, models, span: 14, 15, 16);
        let [fourth, fifth, sixth, seventh] = &D;
        memory.dense_by_rates::<Self>(&[fourth, fifth, sixth, seventh], 2 * P::LINKS, span);
    }

    #[inline(always)]
    fn dense_outputs<R: Register>(memory: &Memory<R>, s: R, out: &mut [R]) {
        memory.alternate::<Self>(s, out);
    }
}
