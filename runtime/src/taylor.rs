//! What emitted recurrences of Taylor coefficients are made of.
//!
//! The coefficient of order k of a product is Σ u\[j\] v\[k−j\]. Its terms with
//! 0 < j < k are known before anything of order k is: [`sums`] forms them for
//! all products, quotients, sines and roots of an equation at once, side by
//! side in vector registers. The terms of order k itself are few, and code
//! written for the equation adds them.
//!
//! These functions are called by emitted code; [`integrate::Taylor`] is the
//! method that uses it.
//!
//! [`integrate::Taylor`]: crate::integrate::Taylor

use core::ops::Range;

use crate::scalar::Scalar;
use crate::scalar::dispatch::{self, Kernel};

/// The factors of the products of one order: left ones, right ones.
pub type Factors<T, const P: usize> = [[T; P]; 2];

/// Writes order 0 (`theta`, `omega`) and order 1 (`omega`, `accelerations`)
/// to `coefficients`, and returns the orders from which the next ones follow.
///
/// Where `factors` has not a row for each of these orders, all coefficients
/// become NaN and no order is left.
#[inline]
pub fn begin<T: Scalar, const N: usize, const D: usize, const P: usize>(
    coefficients: &mut [[T; D]],
    factors: &[Factors<T, P>],
    theta: &[T; N],
    omega: &[T; N],
    accelerations: &[T; N],
) -> Range<usize> {
    let last = coefficients.len().saturating_sub(1).max(1);
    if factors.len() + 1 < last || D != 2 * N {
        coefficients.as_flattened_mut().fill(T::from_f64(f64::NAN));
        return 1..1;
    }
    let orders = [(theta, omega), (omega, accelerations)];
    for (row, (angles, velocities)) in coefficients.iter_mut().zip(orders) {
        let (left, right) = row.split_at_mut(N);
        left.copy_from_slice(angles);
        right.copy_from_slice(velocities);
    }
    1..last
}

/// Σ u\[j\] v\[k−j\] over 0 < j < k for each pair of factors u, v, of which row
/// j − 1 holds the coefficients of order j. The terms are added in pairs from the middle outwards, those
/// with the newest coefficients last.
///
/// Rows that do not exist count as zero. Uses the widest vector instructions of
/// the machine; the results do not depend on them.
///
/// # Examples
/// ```
/// use branched_pendulum::taylor::sums;
///
/// // Orders 1 and 2 of two pairs of factors.
/// let factors = [[[1.0, 2.0], [3.0, 4.0]], [[5.0, 6.0], [7.0, 8.0]]];
/// assert_eq!(sums(3, &factors), [1.0 * 7.0 + 5.0 * 3.0, 2.0 * 8.0 + 6.0 * 4.0]);
/// ```
#[inline(always)]
pub fn sums<T: Scalar, const P: usize>(k: usize, factors: &[Factors<T, P>]) -> [T; P] {
    let rows = factors.get(..k.saturating_sub(1)).unwrap_or(factors);
    dispatch::run_widest(Sums { rows })
}

struct Sums<'a, T, const P: usize> {
    rows: &'a [Factors<T, P>],
}

impl<T: Scalar, const P: usize> Kernel for Sums<'_, T, P> {
    type Output = [T; P];

    #[inline(always)]
    fn run(self) -> [T; P] {
        let mut sums = [T::from_f64(0.0); P];
        // As many sums at once as the registers hold, over all rows.
        let (wide, rest) = sums.as_chunks_mut::<16>();
        let mut at = 0;
        for block in wide {
            sum_block(self.rows, at, block);
            at += 16;
        }
        let (narrow, rest) = rest.as_chunks_mut::<4>();
        for block in narrow {
            sum_block(self.rows, at, block);
            at += 4;
        }
        for sum in rest {
            sum_block(self.rows, at, core::array::from_mut(sum));
            at += 1;
        }
        sums
    }
}

/// The sums from number `at` on.
#[inline(always)]
fn sum_block<T: Scalar, const P: usize, const W: usize>(
    rows: &[Factors<T, P>],
    at: usize,
    sums: &mut [T; W],
) {
    let (early, rest) = rows.split_at(rows.len() / 2);
    let (middle, late) = rest.split_at(rest.len() - early.len());
    let mut partial = *sums;
    for [left, right] in middle {
        let (left, right) = (&left[at..at + W], &right[at..at + W]);
        for i in 0..W {
            partial[i] = left[i] * right[i];
        }
    }
    // From the middle outwards: the coefficients that were written last are
    // read last, when they have arrived in memory.
    for ([u, v], [u_late, v_late]) in early.iter().rev().zip(late) {
        let (u, v) = (&u[at..at + W], &v[at..at + W]);
        let (u_late, v_late) = (&u_late[at..at + W], &v_late[at..at + W]);
        for i in 0..W {
            partial[i] = partial[i] + (u[i] * v_late[i] + u_late[i] * v[i]);
        }
    }
    *sums = partial;
}

/// Writes order k + 1 from order k: θ\[k+1\] = ω\[k\] / (k+1) and
/// ω\[k+1\] = α\[k\] / (k+1), α being `accelerations`.
#[inline(always)]
pub fn advance<T: Scalar, const N: usize, const D: usize>(
    coefficients: &mut [[T; D]],
    k: usize,
    accelerations: &[T; N],
) {
    // A product: its rounding is far below that of order 1, a division takes
    // its time.
    let inverse = T::from_f64(1.0) / whole::<T>(k + 1);
    if let Some([row, next, ..]) = coefficients.get_mut(k..)
        && D == 2 * N
    {
        let (angles, velocities) = next.split_at_mut(N);
        for (out, &rate) in angles.iter_mut().zip(&row[N..]) {
            *out = rate * inverse;
        }
        for (out, &rate) in velocities.iter_mut().zip(accelerations) {
            *out = rate * inverse;
        }
    }
}

/// A whole number, exactly.
#[inline(always)]
pub fn whole<T: Scalar>(k: usize) -> T {
    T::from_f64(k as f64)
}
