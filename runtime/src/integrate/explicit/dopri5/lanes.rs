//! The pair of order 5(4) in lanes.

use super::tables::{A2, A3, A4, A5, A6, B, C, D, E};
use super::{DormandPrince5, ESTIMATE_WEIGHT};
use crate::integrate::explicit::Span;
use crate::integrate::explicit::lanes::{LanePair, Memory, make_stages};
use crate::integrate::lanes::Models;
use crate::scalar::register::Register;
use crate::system::Cast;

impl LanePair for DormandPrince5 {
    const NODES: &'static [f64] = &C;
    const ROWS: &'static [&'static [(usize, f64)]] = &[&A2, &A3, &A4, &A5, &A6, &B];

    #[inline(always)]
    fn stages_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    ) {
        make_stages!(memory, models, span: 2, 3, 4, 5, 6);
    }

    #[inline(always)]
    fn errors<R: Register>(memory: &Memory<R>, n: usize, size: R) -> R {
        R::from_f64(ESTIMATE_WEIGHT) * memory.mean_square_error::<Self>(&E, n, size)
    }

    #[inline(always)]
    fn prepare_dense_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        _models: &Models<P, R>,
        span: Span<R>,
    ) {
        memory.dense_by_rates::<Self>(&[&D], 2 * P::LINKS, span);
    }

    #[inline(always)]
    fn dense_outputs<R: Register>(memory: &Memory<R>, s: R, out: &mut [R]) {
        memory.alternate::<Self>(s, out);
    }
}
