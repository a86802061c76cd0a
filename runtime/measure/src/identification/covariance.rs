//! Standard deviations of the globals (parameters and offsets): from the curvature of the sum of
//! squares, and from the change of the estimate when a block of the record is left out.

use nalgebra::{DMatrix, DVector};

use super::elimination::EliminatedChain;
use super::least_squares::{FitStage, LinearStage};
use super::task::FitTask;
use branched_pendulum::analysis::statistics::jackknife;

/// Rows of one block of time in the normal equations of the globals, after elimination of the
/// initial states.
struct TimeBlock {
    information: DMatrix<f64>,
    pull: DVector<f64>,
}

/// Normal equations of the globals by blocks of time, together with those of the frequencies, whose
/// errors are known.
pub(super) struct TimeBlocks {
    blocks: Vec<TimeBlock>,
    columns: usize,
    /// Rows of the frequencies.
    frequencies: DMatrix<f64>,
    /// Standard deviation of the residuals of the frequencies.
    spread: f64,
}

impl TimeBlocks {
    /// Sorts the rows of a stage into blocks of time of this length, s.
    ///
    /// When the globals change, the initial states of the segments change as the elimination
    /// prescribes, so that each row has a derivative with respect to the globals only.
    pub(super) fn new(
        task: &FitTask<'_>,
        stage: &FitStage,
        linear: &LinearStage,
        elimination: &EliminatedChain,
        length: f64,
    ) -> Option<Self> {
        let columns = task.names.len();
        let responses = elimination.responses()?;
        let first = task.times.first().copied().unwrap_or(0.0);
        let mut all = Self {
            blocks: Vec::new(),
            columns,
            frequencies: linear.prior.columns(0, columns).into_owned(),
            spread: stage.spread,
        };
        for (index, samples) in stage.segments.iter().enumerate() {
            let (segment, response) = (&linear.segments[index], responses.get(index)?);
            let along = along(&segment.data, response);
            let mut row = 0;
            for sample in samples.clone() {
                let block = ((task.times[sample] - first) / length) as usize;
                let rows = task.count(&(sample..sample + 1));
                let data = segment.data.column(segment.data.ncols() - 1);
                for row in row..row + rows {
                    all.add(block, &along.row(row).transpose(), data[row]);
                }
                row += rows;
            }
        }
        all.blocks.retain(|block| block.information.trace() > 0.0);
        Some(all)
    }

    fn add(&mut self, block: usize, slope: &DVector<f64>, residual: f64) {
        while self.blocks.len() <= block {
            self.blocks.push(TimeBlock {
                information: DMatrix::zeros(self.columns, self.columns),
                pull: DVector::zeros(self.columns),
            });
        }
        let block = &mut self.blocks[block];
        block.information.ger(1.0, slope, slope, 1.0);
        block.pull.axpy(residual, slope, 1.0);
    }

    /// Returns the number of blocks.
    pub(super) fn count(&self) -> usize {
        self.blocks.len()
    }

    /// Returns the variances of combinations of the free globals, one row for each combination.
    /// They are computed by the jackknife over blocks, with one Gauss–Newton step for each block
    /// left out (a sandwich estimate whose middle corrects for the pull of a block on the
    /// estimate), plus the contribution of the standard errors of frequencies.
    pub(super) fn variances(
        &self,
        free: &[usize],
        combinations: &DMatrix<f64>,
    ) -> Option<Vec<f64>> {
        let count = self.count();
        if count < free.len() + 2 {
            return None;
        }
        let part = |matrix: &DMatrix<f64>| matrix.select_rows(free).select_columns(free);
        let of_frequencies = self.frequencies.tr_mul(&self.frequencies);
        let total = self
            .blocks
            .iter()
            .fold(of_frequencies, |sum, block| sum + &block.information);
        let mut changes = Vec::with_capacity(count);
        for block in &self.blocks {
            let rest = part(&(&total - &block.information)).cholesky()?;
            changes.push(combinations * rest.solve(&block.pull.select_rows(free)));
        }
        let responses = part(&total).cholesky()?.solve(&combinations.transpose());
        let by_frequencies = self.spread * self.frequencies.select_columns(free) * responses;
        let variance = |row: usize| {
            let change = |block: Option<usize>| block.map_or(0.0, |block| changes[block][row]);
            let by_blocks = jackknife(count, change).ok()?.error.powi(2);
            Some(by_blocks + by_frequencies.column(row).norm_squared())
        };
        (0..combinations.nrows()).map(variance).collect()
    }
}

/// Returns the derivatives of rows with respect to the globals, including the change of the initial
/// states with the globals.
fn along(rows: &DMatrix<f64>, response: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, columns) = response.shape();
    rows.columns(0, n) * response + rows.columns(n, columns)
}

/// Square root of the matrix of the normal equations, for the free globals.
pub(super) struct Curvature {
    root: DMatrix<f64>,
    /// Remaining right-hand side, from which one further step is computed.
    rest: DVector<f64>,
}

impl Curvature {
    /// Creates the curvature from the triangular matrix of all globals with its right-hand side.
    pub(super) fn new(globals: &DMatrix<f64>, free: &[usize]) -> Self {
        let last = globals.column(globals.ncols() - 1).into_owned();
        if free.is_empty() {
            return Self {
                root: DMatrix::zeros(0, 0),
                rest: DVector::zeros(0),
            };
        }
        let decomposed = globals.select_columns(free).qr();
        let mut rest = last;
        decomposed.q_tr_mul(&mut rest);
        Self {
            root: decomposed.unpack_r(),
            rest: rest.rows(0, free.len()).into_owned(),
        }
    }

    /// Returns the variances of combinations of the free globals, one row for each combination,
    /// from the curvature only: valid for data with independent errors of this variance.
    pub(super) fn variances(&self, combinations: &DMatrix<f64>, variance: f64) -> Option<Vec<f64>> {
        let count = self.root.nrows();
        if count == 0 {
            return Some(vec![0.0; combinations.nrows()]);
        }
        let inverse = self
            .root
            .solve_upper_triangular(&DMatrix::identity(count, count))?;
        let rows = combinations * inverse;
        let variances = rows.row_iter().map(|row| variance * row.norm_squared());
        Some(variances.collect())
    }

    /// Returns the distance to the minimum of the sum of squares, in units of this standard
    /// deviation of the data.
    pub(super) fn distance(&self, deviation: f64) -> f64 {
        self.rest.norm() / deviation
    }
}
