//! Least squares along a chain of segments, by elimination of their initial states.
//!
//! The start of a segment is coupled to its data, to the globals and to the start of the next
//! segment. Orthogonal transformations eliminate the starts one after the other, so that a small
//! problem in the globals remains (the square-root form of the information filter; G. J. Bierman,
//! *Factorization methods for discrete sequential estimation*, 1977). The cost is linear in the
//! number of data.

use nalgebra::{DMatrix, DVector};

use super::least_squares::{Damping, FitStage, LinearStage};

/// The normal equations of the chain after all initial states have been eliminated.
pub(super) struct EliminatedChain {
    pivots: Vec<Pivot>,
    /// Rows on the globals with their right-hand sides, one row per global.
    pub(super) globals: DMatrix<f64>,
}

/// Rows that determine the initial state of a segment from that of the next segment, the globals
/// and the right-hand side.
struct Pivot {
    own: DMatrix<f64>,
    next: DMatrix<f64>,
    rest: DMatrix<f64>,
}

impl FitStage {
    /// Eliminates the initial states of all segments.
    pub(super) fn eliminate(
        &self,
        linear: &LinearStage,
        damping: Option<&Damping>,
    ) -> EliminatedChain {
        // Number of columns of the globals and of the right-hand side, which are the last columns
        // of all rows.
        let rest = linear.prior.ncols();
        let mut carried = Rows::new(rest, rest);
        carried.put(&linear.prior);
        if let Some(damping) = damping {
            carried.put_diagonal(&damping.globals);
        }
        let mut carried = carried.matrix;
        let mut pivots = Vec::with_capacity(linear.segments.len());
        for (index, segment) in linear.segments.iter().enumerate() {
            let n = segment.end.nrows();
            let next = self.starts.get(index + 1);
            let ahead = next.map_or(0, Vec::len);
            // Columns: this start, the next one, the globals, the right-hand side.
            let mut rows = Rows::new(n + ahead + rest, rest);
            rows.put(&carried);
            rows.put(&segment.data);
            if let Some(damping) = damping {
                rows.put_diagonal(&damping.starts[index]);
            }
            if let Some(next) = next {
                let mut jump = segment.end.clone();
                for (component, weight) in self.junction.iter().enumerate() {
                    let missing = next[component] - jump[(component, n + rest - 1)];
                    jump[(component, n + rest - 1)] = missing;
                    jump.row_mut(component).scale_mut(*weight);
                }
                let above = rows.put(&jump);
                for (component, weight) in self.junction.iter().enumerate() {
                    rows.matrix[(above + component, n + component)] = -weight;
                }
            }
            let triangle = triangle(rows.matrix);
            pivots.push(Pivot {
                own: triangle.view((0, 0), (n, n)).into_owned(),
                next: triangle.view((0, n), (n, ahead)).into_owned(),
                rest: triangle.view((0, n + ahead), (n, rest)).into_owned(),
            });
            carried = triangle
                .view((n, n), (ahead + rest, ahead + rest))
                .into_owned();
        }
        EliminatedChain {
            pivots,
            globals: triangle(carried).rows(0, rest - 1).into_owned(),
        }
    }
}

/// Rows stacked on each other. A row has columns for an initial state (or none) before the last
/// columns.
struct Rows {
    matrix: DMatrix<f64>,
    /// Number of last columns.
    rest: usize,
}

impl Rows {
    fn new(width: usize, rest: usize) -> Self {
        Self {
            matrix: DMatrix::zeros(0, width),
            rest,
        }
    }

    /// Appends `count` empty rows, and returns the previous number of rows.
    fn grow(&mut self, count: usize) -> usize {
        let above = self.matrix.nrows();
        let matrix = std::mem::replace(&mut self.matrix, DMatrix::zeros(0, 0));
        self.matrix = matrix.resize_vertically(above + count, 0.0);
        above
    }

    fn put(&mut self, rows: &DMatrix<f64>) -> usize {
        let above = self.grow(rows.nrows());
        let start = rows.ncols() - self.rest;
        let before = self.matrix.ncols() - self.rest;
        let mut place = self.matrix.rows_mut(above, rows.nrows());
        let own = rows.columns(0, start);
        place.columns_mut(0, start).copy_from(&own);
        let last = rows.columns(start, self.rest);
        place.columns_mut(before, self.rest).copy_from(&last);
        above
    }

    fn put_diagonal(&mut self, values: &[f64]) {
        let above = self.grow(values.len());
        for (index, &value) in values.iter().enumerate() {
            self.matrix[(above + index, index)] = value;
        }
    }
}

impl EliminatedChain {
    /// Solves for the globals and the initial states; `None` if the matrix is singular.
    pub(super) fn solve(&self) -> Option<(DVector<f64>, Vec<DVector<f64>>)> {
        let unknowns = self.globals.nrows();
        let triangle = self.globals.columns(0, unknowns);
        let globals = match unknowns {
            0 => DVector::zeros(0),
            _ => triangle.solve_upper_triangular(&self.globals.column(unknowns))?,
        };
        let column = DMatrix::from_columns(&[globals.push(-1.0)]);
        let starts = self.back(&column)?;
        let starts = starts.iter().map(|start| start.column(0).into_owned());
        Some((globals, starts.collect()))
    }

    /// Returns the derivatives of the initial states by the globals, one column per global.
    pub(super) fn responses(&self) -> Option<Vec<DMatrix<f64>>> {
        let unknowns = self.globals.nrows();
        self.back(&DMatrix::identity(unknowns + 1, unknowns))
    }

    /// Solves for the initial states by back substitution. `columns` contains the values of the
    /// globals and, in its last row, minus the factor of the right-hand side.
    fn back(&self, columns: &DMatrix<f64>) -> Option<Vec<DMatrix<f64>>> {
        let mut starts: Vec<DMatrix<f64>> = Vec::with_capacity(self.pivots.len());
        for pivot in self.pivots.iter().rev() {
            let mut right = -&pivot.rest * columns;
            if let Some(next) = starts.last().filter(|_| pivot.next.ncols() > 0) {
                right -= &pivot.next * next;
            }
            starts.push(pivot.own.solve_upper_triangular(&right)?);
        }
        starts.reverse();
        Some(starts)
    }
}

/// Returns the square upper triangular matrix with the same normal equations as the rows.
fn triangle(rows: DMatrix<f64>) -> DMatrix<f64> {
    let width = rows.ncols();
    let triangle = match rows.nrows() {
        0 => rows,
        _ => rows.qr().unpack_r(),
    };
    triangle.resize(width, width, 0.0)
}
