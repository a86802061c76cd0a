//! The inverse of the mass matrix, of one tree in each lane.

// One index into all arrays at once.
#![allow(clippy::needless_range_loop)]

use crate::scalar::Scalar;
use crate::taylor::{Start, Tree};

/// −M⁻¹ at the start: the sweeps of
/// [`invert`](crate::taylor::matrix::invert), with the opposite sign.
#[inline(always)]
pub(super) fn negative_inverse<T: Scalar, const N: usize>(
    start: &Start<'_, T, N>,
    tree: &Tree<'_, T, N>,
) -> [[T; N]; N] {
    let (sines, cosines) = (&start.sines, &start.cosines);
    let mut matrix = [[T::from_f64(0.0); N]; N];
    for i in 0..N {
        matrix[i][i] = tree.inertias[i];
    }
    for coupling in tree.couplings {
        let [i, j] = coupling.links;
        let cos_between = cosines[i].mul_add(cosines[j], sines[i] * sines[j]);
        let mut entry = coupling.cosine * cos_between;
        if let Some(sine) = coupling.sine {
            let sin_between = sines[i] * cosines[j] - cosines[i] * sines[j];
            entry = sine.mul_add(sin_between, entry);
        }
        matrix[i][j] = entry;
        matrix[j][i] = entry;
    }
    for k in (0..N).rev() {
        let inverse = T::from_f64(1.0) / matrix[k][k];
        for i in 0..N {
            if i != k {
                let factor = -(matrix[i][k] * inverse);
                for j in 0..=i {
                    if j != k {
                        matrix[i][j] = factor.mul_add(matrix[k][j], matrix[i][j]);
                        matrix[j][i] = matrix[i][j];
                    }
                }
            }
        }
        for i in 0..N {
            if i != k {
                matrix[i][k] = matrix[i][k] * inverse;
                matrix[k][i] = matrix[i][k];
            }
        }
        matrix[k][k] = -inverse;
    }
    matrix
}
