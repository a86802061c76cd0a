//! Standard deviations of globals: from the curvature of the sum of squares alone, and from
//! how the estimate changes when a block of the record is left out.

use nalgebra::{DMatrix, DVector};

use super::elimination::EliminatedChain;
use super::least_squares::{FitStage, LinearStage};
use super::task::FitTask;
use branched_pendulum::analysis::statistics::jackknife;

/// Part of a block of data in the normal equations of the globals, starts eliminated.
struct TimeBlock {
    information: DMatrix<f64>,
    pull: DVector<f64>,
}

/// Normal equations of the globals by blocks of time, beside those of data whose errors are known.
pub(super) struct TimeBlocks {
    blocks: Vec<TimeBlock>,
    columns: usize,
    /// Rows of frequencies.
    frequencies: DMatrix<f64>,
    /// Deviation of their residuals.
    spread: f64,
}

impl TimeBlocks {
    /// Sorts the rows of a stage into blocks of this length, s.
    ///
    /// A change of the globals takes the starts with it, by the responses of the
    /// elimination: along it each row has a derivative with respect to globals alone.
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

    /// Number of blocks.
    pub(super) fn count(&self) -> usize {
        self.blocks.len()
    }

    /// Variances of combinations of the globals that are not held, a row each: the jackknife
    /// over blocks, one step of Gauss and Newton for each that is left out (a sandwich whose
    /// middle allows for what a block itself has drawn the estimate to), and what the standard
    /// errors of frequencies add to it.
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

/// Derivatives of rows with respect to globals, starts responding.
fn along(rows: &DMatrix<f64>, response: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, columns) = response.shape();
    rows.columns(0, n) * response + rows.columns(n, columns)
}

/// The square root of the normal equations of the globals that are free.
pub(super) struct Curvature {
    root: DMatrix<f64>,
    /// What one step more would gain.
    rest: DVector<f64>,
}

impl Curvature {
    /// The curvature of a triangle of all globals, with what its rows make up for.
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

    /// Variances of combinations of the free globals, a row each, by the curvature alone: for
    /// data whose errors are independent and of this variance.
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

    /// Distance of the least sum of squares, in deviations of this size.
    pub(super) fn distance(&self, deviation: f64) -> f64 {
        self.rest.norm() / deviation
    }
}
