//! Frequencies of small motions, as data beside trajectories or in place of them.

use nalgebra::{DMatrix, Schur};

use super::error::IdentificationError;
use super::sensitivity::Sensitivities;
use super::task::FitTask;
use branched_pendulum::system::Ode;

/// A measured frequency of a small motion about hanging at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// Index of its mode, from the slowest on; motions that do not oscillate do not count.
    pub mode: usize,
    /// The frequency, Hz.
    pub hertz: f64,
    /// Standard deviation of the frequency, Hz.
    pub deviation: f64,
}

/// Relative step of the difference quotients: their error is its square.
const STEP: f64 = 1e-5;

impl FitTask<'_> {
    /// Frequencies (Hz) of all modes that oscillate, from the slowest on, with friction as
    /// it is: imaginary parts of eigenvalues of the linear equations.
    fn modes(&self, globals: &[f64]) -> Vec<f64> {
        let n = self.dimension;
        let system = Sensitivities::new(self.family, n, &self.parameters(globals), &[]);
        let start = system.start(&vec![0.0; n]);
        let mut rates = vec![0.0; start.len()];
        system.rates(0.0, &start, &mut rates);
        let matrix = DMatrix::from_fn(n, n, |row, column| rates[system.place(column, row)]);
        if !matrix.iter().all(|value| value.is_finite()) {
            return Vec::new();
        }
        let Some(schur) = Schur::try_new(matrix, f64::EPSILON, 10_000) else {
            return Vec::new();
        };
        let values = schur.complex_eigenvalues();
        let turning = values.iter().filter(|value| value.im > 0.0);
        let mut modes: Vec<f64> = turning
            .map(|value| value.im / core::f64::consts::TAU)
            .collect();
        modes.sort_by(f64::total_cmp);
        modes
    }

    /// Frequencies less data, in deviations.
    pub(super) fn frequency_residuals(&self, globals: &[f64]) -> Option<Vec<f64>> {
        if self.frequencies.is_empty() {
            return Some(Vec::new());
        }
        let modes = self.modes(globals);
        let residual = |datum: &Frequency| {
            let mode = modes.get(datum.mode)?;
            Some((mode - datum.hertz) / datum.deviation)
        };
        self.frequencies.iter().map(residual).collect()
    }

    /// Rows on these globals and what they have to make up for. Differences of frequencies,
    /// not derivatives of eigenvalues, so that equal ones are no special case.
    pub(super) fn frequency_rows(&self, globals: &[f64], free: &[usize]) -> Option<DMatrix<f64>> {
        let count = free.len();
        let mut rows = DMatrix::zeros(self.frequencies.len(), count + 1);
        if self.frequencies.is_empty() {
            return Some(rows);
        }
        for (row, residual) in self.frequency_residuals(globals)?.iter().enumerate() {
            rows[(row, count)] = -residual;
        }
        for (column, &global) in free.iter().enumerate() {
            let moved = |step: f64| {
                let mut globals = globals.to_vec();
                globals[global] += step * self.scales[global];
                self.frequency_residuals(&globals)
            };
            let (above, below) = (moved(STEP)?, moved(-STEP)?);
            for (row, (above, below)) in above.iter().zip(&below).enumerate() {
                rows[(row, column)] = (above - below) / (2.0 * STEP);
            }
        }
        Some(rows)
    }

    pub(super) fn check_modes(&self, globals: &[f64]) -> Result<(), IdentificationError> {
        let Some(last) = self.frequencies.iter().map(|datum| datum.mode).max() else {
            return Ok(());
        };
        let modes = self.modes(globals).len();
        match last < modes {
            true => Ok(()),
            false => Err(IdentificationError::Mode { mode: last, modes }),
        }
    }
}
