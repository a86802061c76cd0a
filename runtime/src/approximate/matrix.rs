//! Square matrices in double-double numbers, small ones.

use alloc::vec::Vec;

use super::error::LinearError;
use crate::scalar::{Double, Scalar};

/// A matrix, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PreciseMatrix {
    columns: usize,
    entries: Vec<Double>,
}

impl PreciseMatrix {
    pub(super) fn new(
        rows: usize,
        columns: usize,
        mut entry: impl FnMut(usize, usize) -> Double,
    ) -> Self {
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let entries = places.map(|(row, column)| entry(row, column)).collect();
        Self { columns, entries }
    }

    pub(super) fn identity(n: usize) -> Self {
        Self::new(n, n, |row, column| {
            number(f64::from(u8::from(row == column)))
        })
    }

    pub(super) fn row(&self, row: usize) -> &[Double] {
        &self.entries[row * self.columns..(row + 1) * self.columns]
    }

    fn row_mut(&mut self, row: usize) -> &mut [Double] {
        &mut self.entries[row * self.columns..(row + 1) * self.columns]
    }

    pub(super) fn at(&self, row: usize, column: usize) -> Double {
        self.row(row)[column]
    }

    fn set(&mut self, row: usize, column: usize, value: Double) {
        self.row_mut(row)[column] = value;
    }

    fn rows(&self) -> usize {
        self.entries.len() / self.columns.max(1)
    }

    pub(super) fn transposed(&self) -> Self {
        Self::new(self.columns, self.rows(), |row, column| {
            self.at(column, row)
        })
    }

    pub(super) fn entries(&self) -> &[Double] {
        &self.entries
    }

    /// Largest absolute value of an entry.
    pub(super) fn size(&self) -> f64 {
        largest(&self.entries)
    }

    /// The mean with the transposed matrix, which must be the same but for rounding.
    pub(super) fn symmetrised(&self, matrix: &'static str) -> Result<Self, LinearError> {
        let limit = ASYMMETRY * self.size();
        let n = self.columns;
        let mut pairs = (0..n).flat_map(|row| (0..row).map(move |column| (row, column)));
        let skew = |(i, j)| (self.at(i, j) - self.at(j, i)).high().abs() > limit;
        if pairs.any(skew) {
            return Err(LinearError::NotSymmetric { matrix });
        }
        let half = number(0.5);
        Ok(Self::new(n, n, |i, j| {
            half * (self.at(i, j) + self.at(j, i))
        }))
    }

    pub(super) fn scaled(mut self, factor: f64) -> Self {
        let factor = number(factor);
        self.entries
            .iter_mut()
            .for_each(|entry| *entry = factor * *entry);
        self
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (entry, &other) in self.entries.iter_mut().zip(&other.entries) {
            *entry += other;
        }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let zero = number(0.0);
        let mut product = Self::new(self.rows(), other.columns, |_, _| zero);
        for row in 0..self.rows() {
            for (k, &factor) in self
                .row(row)
                .iter()
                .enumerate()
                .filter(|(_, f)| **f != zero)
            {
                for (sum, &entry) in product.row_mut(row).iter_mut().zip(other.row(k)) {
                    *sum += factor * entry;
                }
            }
        }
        product
    }

    /// The lower triangle L of L Lᵀ, none where the matrix is not positive definite.
    pub(super) fn cholesky(&self) -> Option<Self> {
        let n = self.columns;
        let mut lower = Self::new(n, n, |_, _| number(0.0));
        for row in 0..n {
            for column in 0..=row {
                let pairs = lower.row(row)[..column].iter().zip(lower.row(column));
                let rest = pairs.fold(self.at(row, column), |rest, (&a, &b)| rest - a * b);
                let entry = if row > column {
                    rest / lower.at(column, column)
                } else if rest > number(0.0) {
                    rest.sqrt()
                } else {
                    return None;
                };
                lower.set(row, column, entry);
            }
        }
        Some(lower)
    }

    /// L⁻¹ B, with this matrix as the lower triangle L.
    pub(super) fn solve_lower(&self, mut right: Self) -> Self {
        for row in 0..self.columns {
            for k in 0..row {
                right.take_row(row, self.at(row, k), k);
            }
            right.divide_row(row, self.at(row, row));
        }
        right
    }

    /// L⁻ᵀ B, with this matrix as the lower triangle L.
    pub(super) fn solve_upper(&self, mut right: Self) -> Self {
        for row in (0..self.columns).rev() {
            for k in row + 1..self.columns {
                right.take_row(row, self.at(k, row), k);
            }
            right.divide_row(row, self.at(row, row));
        }
        right
    }

    /// Subtracts a multiple of one row from another.
    fn take_row(&mut self, row: usize, factor: Double, other: usize) {
        for column in 0..self.columns {
            let rest = self.at(row, column) - factor * self.at(other, column);
            self.set(row, column, rest);
        }
    }

    fn divide_row(&mut self, row: usize, divisor: Double) {
        self.row_mut(row)
            .iter_mut()
            .for_each(|entry| *entry = *entry / divisor);
    }

    /// Eigenvalues, ascending, and eigenvectors in columns of a symmetric matrix, by
    /// Jacobi's rotations: G. H. Golub, C. F. Van Loan, *Matrix Computations*, 4th
    /// edition, 2013, section 8.5.
    pub(super) fn eigen(mut self) -> (Vec<Double>, Self) {
        let n = self.columns;
        // Vectors in rows, as rotations go over rows.
        let mut vectors = Self::identity(n);
        let negligible = 1e-30 * self.size();
        for _ in 0..MOST_SWEEPS {
            let mut rotated = false;
            for p in 0..n {
                for q in p + 1..n {
                    if self.at(p, q).high().abs() <= negligible {
                        continue;
                    }
                    rotated = true;
                    let (cosine, sine) = rotation(self.at(p, p), self.at(q, q), self.at(p, q));
                    self.rotate_rows(p, q, cosine, sine);
                    for row in 0..n {
                        let (a, b) = (self.at(row, p), self.at(row, q));
                        self.set(row, p, cosine * a - sine * b);
                        self.set(row, q, sine * a + cosine * b);
                    }
                    vectors.rotate_rows(p, q, cosine, sine);
                }
            }
            if !rotated {
                break;
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| self.at(a, a).high().total_cmp(&self.at(b, b).high()));
        let values = order.iter().map(|&k| self.at(k, k)).collect();
        let sorted = Self::new(n, n, |row, column| vectors.at(order[column], row));
        (values, sorted)
    }

    fn rotate_rows(&mut self, p: usize, q: usize, cosine: Double, sine: Double) {
        for column in 0..self.columns {
            let (a, b) = (self.at(p, column), self.at(q, column));
            self.set(p, column, cosine * a - sine * b);
            self.set(q, column, sine * a + cosine * b);
        }
    }

    /// exp(A h) and ∫₀ʰ exp(A s) ds B: by the series over h/2ᵏ, where the matrix is
    /// small, and k doublings of h.
    pub(super) fn exponential(self, step: f64, input: Self) -> (Self, Self) {
        let n = self.columns;
        let rows = (0..n).map(|row| self.row(row));
        let norm = rows
            .map(|row| row.iter().map(|entry| entry.high().abs()).sum::<f64>())
            .fold(0.0, f64::max);
        let (mut step, mut doublings) = (step, 0);
        while norm * step > SMALL {
            step *= 0.5;
            doublings += 1;
        }
        let small = self.scaled(step);
        let mut power = Self::identity(n);
        let mut result = Self::identity(n);
        let mut integral = input.clone().scaled(step);
        let mut term = input.scaled(step);
        for k in 1..=TERMS {
            // Each term from the one before, divided by exact small numbers.
            power = power.times(&small);
            term = small.times(&term);
            let (number_k, next) = (number(k as f64), number((k + 1) as f64));
            power
                .entries
                .iter_mut()
                .for_each(|entry| *entry = *entry / number_k);
            term.entries
                .iter_mut()
                .for_each(|entry| *entry = *entry / next);
            result.add(&power);
            integral.add(&term);
        }
        for _ in 0..doublings {
            let moved = result.times(&integral);
            integral.add(&moved);
            result = result.times(&result);
        }
        (result, integral)
    }
}

/// Asymmetry, relative to the largest entry, that rounding may leave.
const ASYMMETRY: f64 = 1e-8;

/// Sweeps of Jacobi's method; convergence is quadratic after the first few.
const MOST_SWEEPS: usize = 60;

/// Norm below which the series has [`TERMS`] terms: the next is 1e-34 of the first.
const SMALL: f64 = 1.0 / 64.0;
const TERMS: usize = 13;

/// Cosine and sine that make a symmetric matrix of two rows diagonal.
fn rotation(a: Double, b: Double, off: Double) -> (Double, Double) {
    let one = number(1.0);
    let slope = (b - a) / (off + off);
    let root = (slope * slope + one).sqrt();
    let tangent = if slope < number(0.0) {
        -(one / (root - slope))
    } else {
        one / (root + slope)
    };
    let cosine = one / (tangent * tangent + one).sqrt();
    (cosine, tangent * cosine)
}

pub(super) fn number(value: f64) -> Double {
    Double::from_f64(value)
}

pub(super) fn largest(values: &[Double]) -> f64 {
    let size = |value: &Double| value.high().abs();
    // NaN stays, which the maximum of numbers would leave out.
    values.iter().map(size).fold(0.0, |largest, value| {
        if largest.is_nan() || value <= largest {
            largest
        } else {
            value
        }
    })
}
