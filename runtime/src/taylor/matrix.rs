//! Vectors and dense matrices in packs.

use super::quad::{Pack, Quad};
use crate::scalar::Scalar;

/// Numbers of all links, filled up to whole packs.
pub(super) type Vector<T, const M: usize> = [Quad<T>; M];

/// The matrix with these N columns times x.
#[inline(always)]
pub(super) fn product<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    columns: &[Vector<T, M>],
    x: &[P; M],
) -> [P; M] {
    let zero = [P::splat(T::from_f64(0.0)); M];
    add_product::<T, P, N, M>(&zero, columns, x)
}

/// `base` + the matrix with these N columns times x.
#[inline(always)]
pub(super) fn add_product<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    base: &[P; M],
    columns: &[Vector<T, M>],
    x: &[P; M],
) -> [P; M] {
    let mut sum = *base;
    for (columns, x) in columns[..N].chunks(4).zip(x) {
        let lanes = [
            x.broadcast::<0>(),
            x.broadcast::<1>(),
            x.broadcast::<2>(),
            x.broadcast::<3>(),
        ];
        for (column, lane) in columns.iter().zip(&lanes) {
            for (sum, entries) in sum.iter_mut().zip(column) {
                *sum = sum.plus_product(P::load(entries), *lane);
            }
        }
    }
    sum
}

/// Replaces a symmetric positive definite matrix of N columns by its inverse:
/// Gauss and Jordan's elimination from the last unknown to the first, in the form
/// that keeps the symmetry (sweeps), without an exchange of rows.
#[inline(always)]
pub(super) fn invert<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    columns: &mut [Vector<T, M>],
) {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    for k in (0..N).rev() {
        let (pack, lane) = (k / 4, k % 4);
        let inverse = one / columns[k][pack].0[lane];
        // Column k, with −1 in row k: subtracted from the others with their
        // factors, it eliminates them and leaves the factor in row k.
        let mut eliminating = columns[k];
        eliminating[pack].0[lane] = -one;
        let mut column = [P::splat(zero); M];
        for (value, entries) in column.iter_mut().zip(&eliminating) {
            *value = P::load(entries);
        }
        let mut others = Quad::splat(one);
        others.0[lane] = zero;
        let others = P::load(&others);
        for (j, target) in columns[..N].iter_mut().enumerate() {
            if j == k {
                continue;
            }
            let factor = P::splat(target[pack].0[lane] * inverse);
            for m in 0..M {
                let mut value = P::load(&target[m]);
                if m == pack {
                    value = value.times(others);
                }
                value.minus_product(factor, column[m]).store(&mut target[m]);
            }
        }
        let inverse = P::splat(inverse);
        for m in 0..M {
            column[m].times(inverse).store(&mut columns[k][m]);
        }
    }
    // Sweeps leave the opposite.
    for entries in columns[..N].as_flattened_mut() {
        P::splat(zero).minus(P::load(entries)).store(entries);
    }
}

/// Numbers of all links as packs, zero where there is no link.
#[inline(always)]
pub(super) fn packs<T: Scalar, P: Pack<T>, const N: usize, const M: usize>(
    numbers: &[T; N],
) -> [P; M] {
    let zero = T::from_f64(0.0);
    let mut packs = [P::splat(zero); M];
    for (m, pack) in packs.iter_mut().enumerate() {
        let mut quad = Quad::splat(zero);
        for (i, place) in quad.0.iter_mut().enumerate() {
            if 4 * m + i < N {
                *place = numbers[4 * m + i];
            }
        }
        *pack = P::load(&quad);
    }
    packs
}

/// The numbers of all links.
#[inline(always)]
pub(super) fn numbers<T: Scalar, const N: usize, const M: usize>(
    vector: &Vector<T, M>,
    out: &mut [T; N],
) {
    for (i, out) in out.iter_mut().enumerate() {
        *out = vector[i / 4].0[i % 4];
    }
}

#[cfg(test)]
mod tests {
    use super::{invert, product};
    use crate::taylor::quad::Quad;

    /// 1/(i + j + 1) + δ_ij, of which the inverse is checked by a product.
    #[test]
    fn inverse_times_matrix_is_one() {
        let entry = |i: usize, j: usize| 1.0 / (i + j + 1) as f64 + f64::from(u8::from(i == j));
        let matrix: [[Quad<f64>; 2]; 6] = core::array::from_fn(|j| {
            core::array::from_fn(|m| {
                Quad(core::array::from_fn(|i| {
                    if 4 * m + i < 6 {
                        entry(4 * m + i, j)
                    } else {
                        0.0
                    }
                }))
            })
        });
        let mut inverse = matrix;
        invert::<f64, Quad<f64>, 6, 2>(&mut inverse);
        for (j, column) in matrix.iter().enumerate() {
            let unit: [Quad<f64>; 2] = product::<f64, Quad<f64>, 6, 2>(&inverse, column);
            for i in 0..6 {
                let expected = f64::from(u8::from(i == j));
                assert!((unit[i / 4].0[i % 4] - expected).abs() < 1e-15, "{unit:?}");
            }
        }
    }
}
