//! Least squares along a chain of segments.
//!
//! The start of a segment is tied to its own data, to the globals and to the start of the
//! next: orthogonal transformations eliminate one start after the other, and what is left
//! is a small problem in the globals (the square-root form of the information filter;
//! G. J. Bierman, *Factorization methods for discrete sequential estimation*, 1977). Cost:
//! linear in the data.

use nalgebra::{DMatrix, DMatrixView, DVector};

use super::task::LinearSegment;

/// The chain with all starts eliminated.
pub(super) struct EliminatedChain {
    pivots: Vec<Pivot>,
    /// Rows on the globals and what they make up for: as many as globals.
    pub(super) globals: DMatrix<f64>,
    unknowns: usize,
}

/// The rows that give the start of a segment from that of the next, from the globals, and
/// from what they have to make up for.
struct Pivot {
    own: DMatrix<f64>,
    next: DMatrix<f64>,
    rest: DMatrix<f64>,
}

/// How far a step may go: rows √λ D x = 0.
pub(super) struct Damping {
    /// √λ D of the components of each start.
    pub(super) starts: Vec<Vec<f64>>,
    /// √λ D of the globals.
    pub(super) globals: Vec<f64>,
}

/// The rows of all segments.
pub(super) struct SegmentChain<'a> {
    pub(super) segments: &'a [LinearSegment],
    /// Weights of the components of the jump from a segment to the next; none where
    /// segments are free of each other.
    pub(super) junction: Option<&'a [f64]>,
    /// The states at the starts of the segments.
    pub(super) starts: &'a [Vec<f64>],
    /// Rows on the globals alone.
    pub(super) prior: DMatrix<f64>,
}

impl SegmentChain<'_> {
    /// Eliminates all starts.
    pub(super) fn eliminate(&self, damping: Option<&Damping>) -> EliminatedChain {
        let unknowns = self.prior.ncols() - 1;
        let damped = damping.map(|damping| diagonal(&damping.globals, unknowns + 1, 0));
        let mut carried = stacked(&[Some(&self.prior), damped.as_ref()]);
        let mut pivots = Vec::with_capacity(self.segments.len());
        let mut coupled = DMatrix::zeros(0, 0);
        for (index, segment) in self.segments.iter().enumerate() {
            let n = segment.end.nrows();
            let damped = damping.map(|damping| diagonal(&damping.starts[index], n, 0));
            // Columns: this start, the next one, the globals, the right-hand side.
            let next = match self.starts.get(index + 1) {
                Some(next) if self.junction.is_some() => next.as_slice(),
                _ => &[],
            };
            let wide = n + next.len() + unknowns + 1;
            let rows = |count: usize| DMatrix::<f64>::zeros(count, wide);
            let mut all = Vec::new();
            let mut put = |local: Option<DMatrixView<'_, f64>>, rest: DMatrixView<'_, f64>| {
                let mut block = rows(rest.nrows());
                if let Some(local) = local {
                    block.columns_mut(0, n).copy_from(&local);
                }
                block
                    .columns_mut(n + next.len(), unknowns + 1)
                    .copy_from(&rest);
                all.push(block);
            };
            let local = (coupled.nrows() > 0).then(|| coupled.columns(0, n));
            put(local, carried.columns(0, unknowns + 1));
            put(
                Some(segment.data.columns(0, n)),
                segment.data.columns(n, unknowns + 1),
            );
            if let Some(damped) = &damped {
                let nothing = DMatrix::zeros(n, unknowns + 1);
                put(Some(damped.columns(0, n)), nothing.columns(0, unknowns + 1));
            }
            if let Some(weights) = self.junction.filter(|_| !next.is_empty()) {
                all.push(junction(segment, weights, next, unknowns));
            }
            let all: Vec<Option<&DMatrix<f64>>> = all.iter().map(Some).collect();
            let triangle = triangle(stacked(&all), wide);
            pivots.push(Pivot {
                own: triangle.view((0, 0), (n, n)).into_owned(),
                next: triangle.view((0, n), (n, next.len())).into_owned(),
                rest: triangle
                    .columns(n + next.len(), unknowns + 1)
                    .rows(0, n)
                    .into_owned(),
            });
            let left = triangle.nrows() - n;
            coupled = match next.is_empty() {
                true => DMatrix::zeros(0, 0),
                false => triangle.view((n, n), (left, n)).into_owned(),
            };
            carried = triangle
                .view((n, n + next.len()), (left, unknowns + 1))
                .into_owned();
        }
        EliminatedChain {
            pivots,
            globals: triangle(carried, unknowns + 1)
                .rows(0, unknowns)
                .into_owned(),
            unknowns,
        }
    }
}

/// Rows of the jump at the end of a segment.
fn junction(
    segment: &LinearSegment,
    weights: &[f64],
    next: &[f64],
    unknowns: usize,
) -> DMatrix<f64> {
    let n = next.len();
    DMatrix::from_fn(n, 2 * n + unknowns + 1, |component, column| {
        let weight = weights[component];
        let at = |column: usize| segment.end[(component, column)];
        weight
            * match column {
                column if column < n => at(column),
                column if column < 2 * n => -f64::from(u8::from(column - n == component)),
                column if column < 2 * n + unknowns => at(column - n),
                _ => next[component] - at(n + unknowns),
            }
    })
}

impl EliminatedChain {
    /// Solves for globals, which are as many as rows, and starts.
    pub(super) fn solve(&self) -> Option<(DVector<f64>, Vec<DVector<f64>>)> {
        let triangle = self.globals.columns(0, self.unknowns);
        let right = self.globals.column(self.unknowns);
        let globals = match self.unknowns {
            0 => DVector::zeros(0),
            _ => triangle.solve_upper_triangular(&right)?,
        };
        let mut column = DMatrix::from_element(self.unknowns + 1, 1, -1.0);
        column
            .view_mut((0, 0), (self.unknowns, 1))
            .copy_from(&globals);
        let starts = self.back(&column)?;
        let starts = starts.iter().map(|start| start.column(0).into_owned());
        Some((globals, starts.collect()))
    }

    /// Returns how the starts change with the globals: a column a global.
    pub(super) fn responses(&self) -> Option<Vec<DMatrix<f64>>> {
        let unit = DMatrix::identity(self.unknowns + 1, self.unknowns);
        self.back(&unit)
    }

    /// Starts for columns of globals and, in the last row, of minus the right-hand side.
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

fn diagonal(values: &[f64], width: usize, from: usize) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(values.len(), width);
    for (index, &value) in values.iter().enumerate() {
        rows[(index, from + index)] = value;
    }
    rows
}

fn stacked(blocks: &[Option<&DMatrix<f64>>]) -> DMatrix<f64> {
    let blocks = || blocks.iter().flatten();
    let width = blocks().map(|block| block.ncols()).max().unwrap_or(0);
    let mut all = DMatrix::zeros(blocks().map(|block| block.nrows()).sum(), width);
    let mut row = 0;
    for block in blocks() {
        all.rows_mut(row, block.nrows()).copy_from(block);
        row += block.nrows();
    }
    all
}

/// Upper triangle of the same normal equations, of `size` rows.
fn triangle(rows: DMatrix<f64>, size: usize) -> DMatrix<f64> {
    let given = match rows.nrows() {
        0 => rows,
        _ => rows.qr().unpack_r(),
    };
    given.resize(size, size, 0.0)
}
