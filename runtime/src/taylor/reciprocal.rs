//! Accurate division by the order.

use crate::scalar::Scalar;
use crate::simd::Simd;

/// The number 1/n as the sum of two parts. A single rounded reciprocal would cause the same error
/// in every step of a run.
#[derive(Clone, Copy)]
pub(super) struct Reciprocal<P> {
    high: P,
    /// Low part of 1/n; zero if the machine has no fused multiply–add.
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

/// Divisors of order k.
#[derive(Clone, Copy)]
pub(super) struct Divisors<P> {
    /// The number k + 1.
    pub(super) next: P,
    /// The number 1/k.
    pub(super) over_k: Reciprocal<P>,
    /// The number 1/(k (k+1)).
    pub(super) over_both: Reciprocal<P>,
    /// The number 1/(k+1).
    pub(super) over_next: Reciprocal<P>,
}

impl<P: Scalar> Divisors<P> {
    /// Returns the divisors of order k from 1/k, which the order before also used.
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
