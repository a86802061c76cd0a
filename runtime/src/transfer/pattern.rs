//! Symmetric matrices whose entries stand between links and the links above them.

use alloc::vec::Vec;
use core::ops::Range;

use crate::scalar::Scalar;

/// Places of the entries of such a matrix: the diagonal, and for each link one for each link
/// above it, the nearest first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    starts: Vec<usize>,
    above: Vec<usize>,
}

impl Pattern {
    /// The pattern of links that hang from these, each of which stands before it.
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

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of entries beside the diagonal.
    pub(super) fn entries(&self) -> usize {
        self.above.len()
    }

    /// The entries of a row.
    #[inline(always)]
    fn row(&self, row: usize) -> Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// Place of the entry of a row and the one so many steps above its parent.
    #[inline(always)]
    pub(super) fn place(&self, row: usize, step: usize) -> usize {
        self.starts[row] + step
    }

    /// All entries beside the diagonal: their place, row and column.
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let rows = 0..self.rows();
        rows.flat_map(move |row| {
            let own = self.row(row);
            own.map(move |place| (place, row, self.above[place]))
        })
    }

    /// Rows from a row to the root, itself first, with the place of its entry with each.
    #[inline(always)]
    pub(super) fn upwards(&self, row: usize) -> impl Iterator<Item = (usize, usize)> {
        self.row(row).map(|place| (place, self.above[place]))
    }
}

/// Entries of a matrix with a pattern.
#[derive(Debug)]
pub(super) struct Entries<'a, T> {
    pub(super) diagonal: &'a mut [T],
    pub(super) beside: &'a mut [T],
}

impl<T: Scalar> Entries<'_, T> {
    /// Turns the matrix into D⁻¹ and L of LᵀDL (physics (2.1)): links are eliminated from the
    /// leaves up, and no entry comes to be.
    pub(super) fn factor(&mut self, pattern: &Pattern) {
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

    /// Solves with the factors.
    pub(super) fn solve(&self, pattern: &Pattern, values: &mut [T]) {
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

/// Writes the product of a matrix and a vector.
pub(super) fn multiply<T: Scalar>(
    pattern: &Pattern,
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

/// Writes the derivatives of xᵀ M y by each angle, with `slopes` those of the entries by the
/// angle of their row, the negative of those by the angle of their column.
pub(super) fn write_slopes<T: Scalar>(
    pattern: &Pattern,
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
