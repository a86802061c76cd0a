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
