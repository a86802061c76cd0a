//! The equations of motion of one order, solved by matrices.
//!
//! X = M S − T C and Y = M C + T S, with the mass matrix
//! M_ij = A_ij cos(θ_i − θ_j) + B_ij sin(θ_i − θ_j) and
//! T_ij = A_ij sin(θ_i − θ_j) − B_ij cos(θ_i − θ_j) at the start, where
//! A_ij + i B_ij = (ℓ − i w) (h + i e) for the moment (h, e) of a link j and the place
//! (ℓ, w) on its ancestor i from which the branch with it hangs. One inverse serves all
//! orders: S = M⁻¹ (X + T C).

// One index into all arrays at once.
#![allow(clippy::needless_range_loop)]

use super::elimination::LinkColumn;
use super::expand::{Connectivity, LinkConstants, Start};
use super::linear::OrderSystem;
use crate::scalar::Scalar;
use crate::simd::{Quad, Simd};

/// The matrices of a start, by columns.
pub(super) struct Matrices<T, const N: usize, const Q: usize> {
    mass: [LinkColumn<T, Q>; N],
    inverse: [LinkColumn<T, Q>; N],
    turning: [LinkColumn<T, Q>; N],
}

impl<T: Scalar, const N: usize, const Q: usize> OrderSystem<T, N> for Matrices<T, N, Q> {
    #[inline(always)]
    fn new<C: Connectivity<N>, P: Simd<T>>(
        start: &Start<'_, T, N>,
        constants: &LinkConstants<T, N>,
    ) -> Self {
        let zero = Quad::splat(T::from_f64(0.0));
        let (mut along, mut across) = ([[zero; Q]; N], [[zero; Q]; N]);
        for j in 0..N {
            let [h, e] = constants.moments[j];
            let mut branch = j;
            while branch > 0 {
                let i = C::PARENTS[branch];
                let [l, w] = constants.attachments[branch];
                let mut coupling = l * h;
                if C::LATERAL {
                    coupling = coupling + w * e;
                    let sideways = l * e - w * h;
                    across[j][i / 4].0[i % 4] = sideways;
                    across[i][j / 4].0[j % 4] = -sideways;
                }
                along[j][i / 4].0[i % 4] = coupling;
                along[i][j / 4].0[j % 4] = coupling;
                branch = i;
            }
        }
        let (mut sines, mut cosines) = ([zero; Q], [zero; Q]);
        for i in 0..N {
            sines[i / 4].0[i % 4] = start.sines[i];
            cosines[i / 4].0[i % 4] = start.cosines[i];
        }
        let (mut mass, mut turning) = ([[zero; Q]; N], [[zero; Q]; N]);
        for j in 0..N {
            let (cosine, sine) = (P::splat(start.cosines[j]), P::splat(start.sines[j]));
            // Not written into the column afterwards: that would have to reach the
            // memory before the column can be read.
            let mut diagonal = [zero; Q];
            diagonal[j / 4].0[j % 4] = constants.inertias[j];
            for m in 0..Q {
                let (sines, cosines) = (P::load_quad(&sines, m), P::load_quad(&cosines, m));
                let cos_between = (cosines * cosine).plus_product(sines, sine);
                let sin_between = (sines * cosine).minus_product(cosines, sine);
                let coupling = P::load_quad(&along[j], m);
                let mut entry = P::load_quad(&diagonal, m).plus_product(coupling, cos_between);
                let mut slope = coupling * sin_between;
                if C::LATERAL {
                    let sideways = P::load_quad(&across[j], m);
                    entry = entry.plus_product(sideways, sin_between);
                    slope = slope.minus_product(sideways, cos_between);
                }
                entry.store_quad(&mut mass[j], m);
                slope.store_quad(&mut turning[j], m);
            }
        }
        let mut inverse = mass;
        invert::<T, P, N, Q>(&mut inverse);
        Self {
            mass,
            inverse,
            turning,
        }
    }

    #[inline(always)]
    fn add_solution<C: Connectivity<N>, P: Simd<T>, const M: usize>(
        &self,
        [base_s, base_y]: [[P; M]; 2],
        force: &[P; M],
        cosine: &[P; M],
    ) -> [[P; M]; 2] {
        let sum = add_product::<T, P, N, Q, M>(force, &self.turning, cosine);
        let own_s = product::<T, P, N, Q, M>(&self.inverse, &sum);
        let y = add_product::<T, P, N, Q, M>(&base_y, &self.mass, cosine);
        let y = add_product::<T, P, N, Q, M>(&y, &self.turning, &own_s);
        let mut s = base_s;
        for m in 0..M {
            s[m] = s[m] + own_s[m];
        }
        [s, y]
    }
}

/// The matrix with these N columns times x.
#[inline(always)]
fn product<T: Scalar, P: Simd<T>, const N: usize, const Q: usize, const M: usize>(
    columns: &[LinkColumn<T, Q>],
    x: &[P; M],
) -> [P; M] {
    let zero = [P::splat(T::from_f64(0.0)); M];
    add_product::<T, P, N, Q, M>(&zero, columns, x)
}

/// `base` + the matrix with these N columns times x.
#[inline(always)]
fn add_product<T: Scalar, P: Simd<T>, const N: usize, const Q: usize, const M: usize>(
    base: &[P; M],
    columns: &[LinkColumn<T, Q>],
    x: &[P; M],
) -> [P; M] {
    let mut sum = *base;
    for (columns, x) in columns[..N].chunks(4).zip(x) {
        let mut lanes = [T::from_f64(0.0); 4];
        x.store(&mut lanes);
        let lanes = lanes.map(P::splat);
        for (column, lane) in columns.iter().zip(&lanes) {
            for (m, sum) in sum.iter_mut().enumerate() {
                *sum = sum.plus_product(P::load_quad(column, m), *lane);
            }
        }
    }
    sum
}

/// Replaces a symmetric positive definite matrix of N columns by its inverse:
/// Gauss and Jordan's elimination from the last unknown to the first, in the form
/// that keeps the symmetry (sweeps), without an exchange of rows.
#[inline(always)]
fn invert<T: Scalar, P: Simd<T>, const N: usize, const Q: usize>(columns: &mut [LinkColumn<T, Q>]) {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    for k in (0..N).rev() {
        let (pack, lane) = (k / 4, k % 4);
        let inverse = one / columns[k][pack].0[lane];
        // LinkColumn k, with −1 in row k: subtracted from the others with their
        // factors, it eliminates them and leaves the factor in row k.
        let mut eliminating = columns[k];
        eliminating[pack].0[lane] = -one;
        let mut column = [P::splat(zero); Q];
        for (m, value) in column.iter_mut().enumerate() {
            *value = P::load_quad(&eliminating, m);
        }
        let mut others = [Quad::splat(one)];
        others[0].0[lane] = zero;
        let others = P::load_quad(&others, 0);
        for (j, target) in columns[..N].iter_mut().enumerate() {
            if j == k {
                continue;
            }
            let factor = P::splat(target[pack].0[lane] * inverse);
            for m in 0..Q {
                let mut value = P::load_quad(target, m);
                if m == pack {
                    value = value * others;
                }
                value.minus_product(factor, column[m]).store_quad(target, m);
            }
        }
        let inverse = P::splat(inverse);
        for m in 0..Q {
            (column[m] * inverse).store_quad(&mut columns[k], m);
        }
    }
    // Sweeps leave the opposite.
    let entries = columns[..N].as_flattened_mut();
    for m in 0..N * Q {
        (P::splat(zero) - P::load_quad(entries, m)).store_quad(entries, m);
    }
}

#[cfg(test)]
mod tests {
    use super::{invert, product};
    use crate::scalar::Lanes;
    use crate::simd::Quad;

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
        invert::<f64, Lanes<f64, 4>, 6, 2>(&mut inverse);
        for (j, column) in matrix.iter().enumerate() {
            let column = column.map(|quad| Lanes(quad.0));
            let unit = product::<f64, Lanes<f64, 4>, 6, 2, 2>(&inverse, &column);
            for i in 0..6 {
                let expected = f64::from(u8::from(i == j));
                assert!((unit[i / 4].0[i % 4] - expected).abs() < 1e-15, "{unit:?}");
            }
        }
    }
}
