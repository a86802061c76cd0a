//! Divisions by the order.

use crate::scalar::Scalar;
use crate::simd::Pack;

/// 1/n in two parts: a rounded reciprocal would be wrong by the same amount in
/// every step of a run.
#[derive(Clone, Copy)]
pub(super) struct Reciprocal<P> {
    high: P,
    /// Zero where products are not fused with the sums they go into.
    low: P,
}

impl<P> Reciprocal<P> {
    #[inline(always)]
    pub(super) fn of<T: Scalar>(number: T) -> Self
    where
        P: Pack<T>,
    {
        let one = T::from_f64(1.0);
        let high = P::splat(one / number);
        let rest = P::splat(one).minus_product(P::splat(number), high);
        Self {
            high,
            low: rest.times(high),
        }
    }

    #[inline(always)]
    pub(super) fn times<T: Scalar>(self, value: P) -> P
    where
        P: Pack<T>,
    {
        value.times(self.low).plus_product(value, self.high)
    }
}
