//! Divisions by the order.

use crate::scalar::Scalar;
use crate::simd::Simd;

/// 1/n in two parts: a rounded reciprocal would be wrong by the same amount in
/// every step of a run.
#[derive(Clone, Copy)]
pub(super) struct Reciprocal<P> {
    high: P,
    /// Zero where products are not fused with the sums they go into.
    low: P,
}

impl<P: Scalar> Reciprocal<P> {
    #[inline(always)]
    pub(super) fn of(number: P) -> Self {
        let one = P::from_f64(1.0);
        let high = one / number;
        let rest = one.minus_product(number, high);
        Self {
            high,
            low: rest * high,
        }
    }

    #[inline(always)]
    pub(super) fn times(self, value: P) -> P {
        (value * self.low).plus_product(value, self.high)
    }
}

/// What order k is divided by.
#[derive(Clone, Copy)]
pub(super) struct Divisors<P> {
    /// k + 1
    pub(super) next: P,
    /// 1/k
    pub(super) over_k: Reciprocal<P>,
    /// 1/(k (k+1))
    pub(super) over_both: Reciprocal<P>,
    /// 1/(k+1)
    pub(super) over_next: Reciprocal<P>,
}

impl<P: Scalar> Divisors<P> {
    /// Returns those of an order, with its reciprocal, which the order before it had too.
    #[inline(always)]
    pub(super) fn of(k: P, over_k: Reciprocal<P>) -> Self {
        let next = k + P::from_f64(1.0);
        Self {
            next,
            over_k,
            over_both: Reciprocal::of(k * next),
            over_next: Reciprocal::of(next),
        }
    }
}
