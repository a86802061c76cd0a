//! Small dense linear systems.

use alloc::vec;
use alloc::vec::Vec;

use crate::integrate::checkpoint::Memory;
use crate::scalar::Real;

/// A square matrix that is factorised in place by Gaussian elimination with row exchanges.
#[derive(Clone, Debug)]
pub(crate) struct Factored<T> {
    n: usize,
    /// Entries of the matrix, row by row.
    pub(crate) entries: Vec<T>,
    pivots: Vec<usize>,
}

impl<T: Real> Factored<T> {
    /// Allocates a matrix of `n` rows.
    pub(crate) fn new(n: usize) -> Self {
        Self {
            n,
            entries: vec![T::ZERO; n * n],
            pivots: vec![0; n],
        }
    }

    /// Factorises the matrix in `entries` by Gaussian elimination with partial pivoting, in 2n³/3
    /// operations. Returns false if it is singular or not finite.
    pub(crate) fn factorise(&mut self) -> bool {
        let n = self.n;
        let a = &mut self.entries;
        for k in 0..n {
            let mut pivot = k;
            for row in k + 1..n {
                if a[row * n + k].abs() > a[pivot * n + k].abs() {
                    pivot = row;
                }
            }
            let size = a[pivot * n + k].abs();
            if !(size.is_finite() && size > T::ZERO) {
                return false;
            }
            self.pivots[k] = pivot;
            if pivot != k {
                for column in 0..n {
                    a.swap(k * n + column, pivot * n + column);
                }
            }
            for row in k + 1..n {
                let factor = a[row * n + k] / a[k * n + k];
                a[row * n + k] = factor;
                for column in k + 1..n {
                    let product = factor * a[k * n + column];
                    a[row * n + column] = a[row * n + column] - product;
                }
            }
        }
        true
    }

    /// Saves or restores the factors.
    pub(super) fn remember(&mut self, memory: &mut Memory<T>) {
        memory.numbers(&mut self.entries);
        for pivot in &mut self.pivots {
            memory.count(pivot, self.n - 1);
        }
    }

    /// Solves the linear system in place: replaces the right-hand side `right` by the solution, in
    /// 2n² operations.
    pub(crate) fn solve(&self, right: &mut [T]) {
        let n = self.n;
        let a = &self.entries;
        for k in 0..n {
            right.swap(k, self.pivots[k]);
        }
        for row in 0..n {
            for column in 0..row {
                right[row] = right[row] - a[row * n + column] * right[column];
            }
        }
        for row in (0..n).rev() {
            for column in row + 1..n {
                right[row] = right[row] - a[row * n + column] * right[column];
            }
            right[row] = right[row] / a[row * n + row];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Factored;

    #[test]
    fn a_system_that_needs_row_exchanges() {
        let mut matrix = Factored::<f64>::new(3);
        matrix
            .entries
            .copy_from_slice(&[0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 4.0, 0.0, 2.0]);
        assert!(matrix.factorise());
        // The matrix times (1, 2, 3).
        let mut right = [7.0, 3.0, 10.0];
        matrix.solve(&mut right);
        for (found, expected) in right.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let mut matrix = Factored::<f64>::new(2);
        matrix.entries.copy_from_slice(&[1.0, 2.0, 2.0, 4.0]);
        assert!(!matrix.factorise());
        matrix.entries.copy_from_slice(&[f64::NAN, 0.0, 0.0, 1.0]);
        assert!(!matrix.factorise());
    }
}
