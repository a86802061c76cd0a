//! Sums of products of Taylor coefficients, for functions of time.

use crate::scalar::Scalar;
use crate::simd::Quad;

/// Left and right factors of the products of one order.
pub type Factors<T, const Q: usize> = [[Quad<T>; Q]; 2];

/// Returns Σ u\[j\] v\[k−j\] over 0 < j < k for each pair of factors u, v. Row j − 1 holds the
/// factors of order j. The terms with the newest coefficients are added last.
///
/// Rows that do not exist count as zero.
///
/// # Examples
/// ```
/// use branched_pendulum::taylor::{Quad, sums};
///
/// // Orders 1 and 2 of four pairs of factors, all alike.
/// let factors = [(1.0, 3.0), (5.0, 7.0)].map(|(u, v)| [[Quad::splat(u)], [Quad::splat(v)]]);
/// assert_eq!(sums(3, &factors), [Quad::splat(1.0 * 7.0 + 5.0 * 3.0)]);
/// ```
#[inline]
pub fn sums<T: Scalar, const Q: usize>(k: usize, factors: &[Factors<T, Q>]) -> [Quad<T>; Q] {
    let rows = factors.get(..k.saturating_sub(1)).unwrap_or(factors);
    let (early, rest) = rows.split_at(rows.len() / 2);
    let (middle, late) = rest.split_at(rest.len() - early.len());
    let mut sums = [Quad::splat(T::from_f64(0.0)); Q];
    for [left, right] in middle {
        for q in 0..Q {
            for i in 0..4 {
                sums[q].0[i] = left[q].0[i] * right[q].0[i];
            }
        }
    }
    for ([u, v], [u_late, v_late]) in early.iter().rev().zip(late) {
        for q in 0..Q {
            for i in 0..4 {
                let both = u[q].0[i] * v_late[q].0[i] + u_late[q].0[i] * v[q].0[i];
                sums[q].0[i] = sums[q].0[i] + both;
            }
        }
    }
    sums
}

/// Splits `work` into the rows of factors for an expansion of `orders` orders, and the rest. If
/// `work` is too short, the rest is empty.
#[must_use]
pub fn rows<T, const Q: usize>(
    work: &mut [Quad<T>],
    orders: usize,
) -> (&mut [Factors<T, Q>], &mut [Quad<T>]) {
    let (own, left) = work
        .split_at_mut_checked(2 * Q * orders)
        .unwrap_or_default();
    let (own, _) = own.as_chunks_mut::<Q>();
    (own.as_chunks_mut::<2>().0, left)
}

/// Converts a whole number exactly.
#[inline(always)]
pub fn whole<T: Scalar>(k: usize) -> T {
    T::from_f64(k as f64)
}
