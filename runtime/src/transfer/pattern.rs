//! Symmetric matrices with entries between links and their ancestors only.

use alloc::vec::Vec;
use core::ops::Range;

use crate::scalar::Scalar;

/// Sparsity pattern of a symmetric matrix: the diagonal, and for each link one entry per ancestor,
/// the nearest ancestor first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct MatrixPattern {
    starts: Vec<usize>,
    above: Vec<usize>,
}

impl MatrixPattern {
    /// Creates the pattern of links with the given parents, each of which comes before its
    /// children.
    pub(super) fn new(parents: impl Iterator<Item = Option<usize>>) -> Self {
        let (mut starts, mut above) = (alloc::vec![0], Vec::new());
        for parent in parents {
            if let Some(parent) = parent {
                let own = starts[parent]..starts[parent + 1];
                above.push(parent);
                above.extend_from_within(own);
            }
            starts.push(above.len());
        }
        Self { starts, above }
    }

    /// Returns the number of rows.
    pub(super) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns the number of off-diagonal entries of the matrix.
    pub(super) fn entries(&self) -> usize {
        self.above.len()
    }

    /// Returns the indices of the entries of a row.
    #[inline(always)]
    fn row(&self, row: usize) -> Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// Returns the index of the entry between a row and the ancestor `step` steps above its parent.
    #[inline(always)]
    pub(super) fn entry_index(&self, row: usize, step: usize) -> usize {
        self.starts[row] + step
    }

    /// Iterates over all off-diagonal entries: index, row and column.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let rows = 0..self.rows();
        rows.flat_map(move |row| {
            let own = self.row(row);
            own.map(move |place| (place, row, self.above[place]))
        })
    }

    /// Iterates over the row and its ancestors up to the root, each with the index of its entry.
    #[inline(always)]
    pub(super) fn upwards(&self, row: usize) -> impl Iterator<Item = (usize, usize)> {
        self.row(row).map(|place| (place, self.above[place]))
    }
}

/// Entries of a symmetric matrix whose sparsity pattern is known.
#[derive(Debug)]
pub(super) struct Entries<'a, T> {
    pub(super) diagonal: &'a mut [T],
    pub(super) beside: &'a mut [T],
}

impl<T: Scalar> Entries<'_, T> {
    /// Factorises the matrix M = LᵀDL in place: the entries become D⁻¹ and L (physics (2.1)). Links
    /// are eliminated from the leaves upwards, without fill-in.
    pub(super) fn factor(&mut self, pattern: &MatrixPattern) {
        for row in (0..pattern.rows()).rev() {
            let own = pattern.row(row);
            let inverse = T::from_f64(1.0) / self.diagonal[row];
            self.diagonal[row] = inverse;
            for place in own.clone() {
                let column = pattern.above[place];
                let factor = self.beside[place] * inverse;
                self.diagonal[column] = self.diagonal[column] - factor * self.beside[place];
                let further = pattern.row(column).zip(place + 1..own.end);
                for (target, source) in further {
                    self.beside[target] = self.beside[target] - factor * self.beside[source];
                }
                self.beside[place] = factor;
            }
        }
    }

    /// Solves a linear system in place, with the factors D⁻¹ and L of its matrix.
    pub(super) fn solve(&self, pattern: &MatrixPattern, values: &mut [T]) {
        for row in (0..pattern.rows()).rev() {
            for (place, column) in pattern.upwards(row) {
                values[column] = values[column] - self.beside[place] * values[row];
            }
        }
        for row in 0..pattern.rows() {
            let mut value = values[row] * self.diagonal[row];
            for (place, column) in pattern.upwards(row) {
                value = value - self.beside[place] * values[column];
            }
            values[row] = value;
        }
    }
}

/// Writes the product of a symmetric matrix (`diagonal` and off-diagonal entries `beside`) and a
/// vector.
pub(super) fn multiply<T: Scalar>(
    pattern: &MatrixPattern,
    diagonal: &[T],
    beside: &[T],
    vector: &[T],
    product: &mut [T],
) {
    for (product, (&diagonal, &own)) in product.iter_mut().zip(diagonal.iter().zip(vector)) {
        *product = diagonal * own;
    }
    for (place, row, column) in pattern.iter() {
        product[row] = product[row] + beside[place] * vector[column];
        product[column] = product[column] + beside[place] * vector[row];
    }
}

/// Writes the derivatives of xᵀ M y by each angle. `slopes` are the derivatives of the entries of M
/// by the angle of their row; the derivatives by the angle of their column have the opposite sign.
pub(super) fn write_slopes<T: Scalar>(
    pattern: &MatrixPattern,
    slopes: &[T],
    [x, y]: [&[T]; 2],
    result: &mut [T],
) {
    result.fill(T::from_f64(0.0));
    for (place, row, column) in pattern.iter() {
        let slope = slopes[place] * (x[row] * y[column] + x[column] * y[row]);
        result[row] = result[row] + slope;
        result[column] = result[column] - slope;
    }
}
