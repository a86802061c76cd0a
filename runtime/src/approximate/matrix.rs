//! Small square matrices of double-double numbers.

use alloc::vec::Vec;

use super::error::LinearError;
use crate::scalar::{Double, Scalar};

/// A square matrix, stored row by row.
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

    /// Returns the largest absolute value of an entry of the matrix.
    pub(super) fn size(&self) -> f64 {
        largest(&self.entries)
    }

    /// Returns the mean of the matrix and its transpose, which may differ only by rounding. The
    /// error names `matrix`, the kind of matrix.
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

    /// Returns the Cholesky factor: the lower triangle L with L Lᵀ equal to this matrix. `None` if
    /// the matrix is not positive definite.
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

    /// Returns L⁻¹ B for B = `right`, where L is the lower triangle of this matrix.
    pub(super) fn solve_lower(&self, mut right: Self) -> Self {
        for row in 0..self.columns {
            for k in 0..row {
                right.take_row(row, self.at(row, k), k);
            }
            right.divide_row(row, self.at(row, row));
        }
        right
    }

    /// Returns L⁻ᵀ B for B = `right`, where L is the lower triangle of this matrix.
    pub(super) fn solve_upper(&self, mut right: Self) -> Self {
        for row in (0..self.columns).rev() {
            for k in row + 1..self.columns {
                right.take_row(row, self.at(k, row), k);
            }
            right.divide_row(row, self.at(row, row));
        }
        right
    }

    /// Subtracts `factor` times row `other` from row `row`.
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

    /// Returns the eigenvalues of a symmetric matrix, ascending, and its eigenvectors in columns,
    /// by Jacobi's rotations: G. H. Golub, C. F. Van Loan, *Matrix Computations*, 4th edition,
    /// 2013, section 8.5.
    pub(super) fn eigen(mut self) -> (Vec<Double>, Self) {
        let n = self.columns;
        // Keeps the eigenvectors in rows, since rotations combine rows.
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

    /// Returns exp(A h) and ∫₀ʰ exp(A s) ds B for this matrix A, h = `step` and B = `input`:
    /// computed by the power series for h/2ᵏ, with k so large that A h/2ᵏ is small, and k
    /// doublings.
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
            // Computes each term from the one before, divided by a small whole number, which is
            // exact.
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

/// Largest asymmetry of a matrix, relative to its largest entry, that counts as rounding.
const ASYMMETRY: f64 = 1e-8;

/// Largest number of sweeps of Jacobi's method, which converges quadratically after the first few.
const MOST_SWEEPS: usize = 60;

/// Norm below which the power series is cut after [`TERMS`] terms: the next term is 1e-34 of the
/// first.
const SMALL: f64 = 1.0 / 64.0;
const TERMS: usize = 13;

/// Returns the cosine and sine of the rotation that makes the symmetric matrix \[\[a, off\], \[off,
/// b\]\] diagonal.
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
    // Keeps NaN, which `f64::max` would drop.
    values.iter().map(size).fold(0.0, |largest, value| {
        if largest.is_nan() || value <= largest {
            largest
        } else {
            value
        }
    })
}
