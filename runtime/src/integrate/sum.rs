//! Sums that keep their rounding error.

use crate::scalar::Scalar;

/// Knuth's two-sum: the rounded sum and its rounding error, exactly.
#[inline(always)]
pub(crate) fn two_sum<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}
