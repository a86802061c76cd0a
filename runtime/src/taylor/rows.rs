//! The series that an expansion keeps, and the sums of their products.

use super::matrix::Vector;
use super::quad::Pack;
use crate::scalar::Scalar;

/// Series that are kept: ω, γ, σ, X, Y. Row r has order r of ω, r + 1 of γ and σ,
/// r − 1 of X and Y, so that all sums of order k run over rows j and k − j.
pub(super) const SERIES: usize = 5;

/// Sums of products in one order.
pub(super) struct Sums<P> {
    /// Σ ω\[j\] γ\[k+1−j\]
    pub(super) omega_cos: P,
    /// Σ ω\[j\] σ\[k+1−j\]
    pub(super) omega_sin: P,
    /// Σ σ\[j+1\] Y\[k−1−j\] − γ\[j+1\] X\[k−1−j\]
    pub(super) force: P,
}

/// The sums over all rows, each with the one as far from the other end, from
/// the middle outwards: what was formed last is added last.
#[inline(always)]
pub(super) fn sums<T: Scalar, P: Pack<T>, const M: usize>(
    rows: &[[Vector<T, M>; SERIES]],
    m: usize,
) -> Sums<P> {
    let (early, rest) = rows.split_at(rows.len() / 2);
    let (middle, late) = rest.split_at(rest.len() - early.len());
    // Two partial sums each, so that none waits for the other.
    let mut partial = [P::splat(T::from_f64(0.0)); 8];
    for row in middle {
        let [omega, cos, sin, x, y] = load::<T, P, M>(row, m);
        partial[0] = omega.times(cos);
        partial[2] = omega.times(sin);
        partial[4] = partial[4].minus_product(cos, x);
        partial[6] = sin.times(y);
    }
    for (row, opposite) in early.iter().rev().zip(late) {
        let [omega, cos, sin, x, y] = load::<T, P, M>(row, m);
        let [omega_2, cos_2, sin_2, x_2, y_2] = load::<T, P, M>(opposite, m);
        partial[0] = partial[0].plus_product(omega, cos_2);
        partial[1] = partial[1].plus_product(omega_2, cos);
        partial[2] = partial[2].plus_product(omega, sin_2);
        partial[3] = partial[3].plus_product(omega_2, sin);
        partial[4] = partial[4].minus_product(cos, x_2);
        partial[5] = partial[5].minus_product(cos_2, x);
        partial[6] = partial[6].plus_product(sin, y_2);
        partial[7] = partial[7].plus_product(sin_2, y);
    }
    Sums {
        omega_cos: partial[0].plus(partial[1]),
        omega_sin: partial[2].plus(partial[3]),
        force: (partial[4].plus(partial[6])).plus(partial[5].plus(partial[7])),
    }
}

/// All series of one row.
#[inline(always)]
fn load<T: Scalar, P: Pack<T>, const M: usize>(
    row: &[Vector<T, M>; SERIES],
    m: usize,
) -> [P; SERIES] {
    [
        P::load(&row[0][m]),
        P::load(&row[1][m]),
        P::load(&row[2][m]),
        P::load(&row[3][m]),
        P::load(&row[4][m]),
    ]
}
