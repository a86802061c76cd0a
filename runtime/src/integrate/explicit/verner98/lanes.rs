//! The pair of order 9(8) in lanes.

use super::tables::{
    A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16, A18, A19, A20, A21, B, C, D,
    DEGREE, STAGES_DENSE,
};
use super::{B_MINUS_EIGHTH, Verner9, bernstein};
use crate::integrate::explicit::Span;
use crate::integrate::explicit::lanes::{LanePair, Memory, make_stages, sum};
use crate::integrate::lanes::Models;
use crate::scalar::register::Register;
use crate::system::Cast;

impl LanePair for Verner9 {
    const NODES: &'static [f64] = &C;
    const ROWS: &'static [&'static [(usize, f64)]] = &[
        &A2, &A3, &A4, &A5, &A6, &A7, &A8, &A9, &A10, &A11, &A12, &A13, &A14, &A15, &A16, &B, &A18,
        &A19, &A20, &A21,
    ];

    #[inline(always)]
    fn stages_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    ) {
        make_stages!(memory, models, span: 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
    }

    #[inline(always)]
    fn errors<R: Register>(memory: &Memory<R>, n: usize, size: R) -> R {
        memory.mean_square_error::<Self>(&B_MINUS_EIGHTH, n, size)
    }

    #[inline(always)]
    fn prepare_dense_in_lanes<P: Cast<R::Lane>, R: Register>(
        memory: &mut Memory<R>,
        models: &Models<P, R>,
        span: Span<R>,
    ) {
        make_stages!(memory, models, span: 18, 19, 20, 21);
        let n = 2 * P::LINKS;
        let rates = &memory.rates[..STAGES_DENSE * n];
        let part = span.step / R::from_f64(DEGREE as f64);
        let (first, rest) = memory.dense.split_at_mut(n);
        let (inner, last_two) = rest.split_at_mut((DEGREE - 3) * n);
        let (before_last, last) = last_two.split_at_mut(n);
        for i in 0..n {
            first[i] = part * rates[i];
            last[i] = memory.end[i] - memory.start[i];
            before_last[i] = last[i] - part * rates[16 * n + i];
        }
        for (row, coefficients) in D.iter().zip(inner.chunks_exact_mut(n)) {
            for (i, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient = span.step * sum(row, rates, n, i);
            }
        }
    }

    #[inline(always)]
    fn dense_outputs<R: Register>(memory: &Memory<R>, s: R, out: &mut [R]) {
        let n = memory.start.len();
        let weights = bernstein(s);
        for (i, (out, &start)) in out.iter_mut().zip(&memory.start).enumerate() {
            let mut sum = R::from_f64(0.0);
            for (term, &weight) in memory.dense.chunks_exact(n).zip(&weights) {
                sum = weight.mul_add(term[i], sum);
            }
            *out = start + sum;
        }
    }
}
