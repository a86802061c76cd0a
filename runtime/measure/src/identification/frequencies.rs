//! Frequencies of small motions, as data in addition to trajectories or instead of them.

use nalgebra::{DMatrix, DVector, Schur};

use super::error::IdentificationError;
use super::fit::FittedFrequency;
use super::sensitivity::Sensitivities;
use super::task::{FitTask, FrequencyDatum};
use branched_pendulum::system::Ode;

/// A measured frequency of a small motion about equilibrium.
///
/// It is compared with the modes without friction: viscous friction lowers a frequency by the
/// relative amount ζ²/2 with the damping ratio ζ, and dry friction does not. A drive has its value
/// at time 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// Value of the frequency, Hz.
    pub hertz: f64,
    /// Standard error of the frequency, Hz.
    pub deviation: f64,
    /// Number of the mode, 1 for the slowest of those that oscillate. If no frequency has a number,
    /// there must be one for each of these modes, in ascending order.
    pub mode: Option<usize>,
}

/// Relative step of difference quotients; their relative error is the square of it.
const STEP: f64 = 1e-5;
/// Largest number of Newton steps to the equilibrium; then the largest step, and the step at which
/// the search ends, in rad.
const STEPS_TO_REST: usize = 100;
const LONGEST_STEP: f64 = 0.5;
const AT_REST: f64 = 1e-12;
/// Squared frequency, relative to that of the fastest mode, below which a mode does not oscillate.
const ROUNDING: f64 = 1e-12;

impl FitTask<'_> {
    /// Returns the accelerations of the links at rest at the given angles, and their derivatives by
    /// the angles.
    fn at_rest(&self, system: &Sensitivities<'_>, angles: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        let links = angles.len();
        let mut state = angles.to_vec();
        state.resize(2 * links, 0.0);
        let start = system.start(&state);
        let mut rates = vec![0.0; start.len()];
        system.rates(0.0, &start, &mut rates);
        let accelerations = DVector::from_column_slice(&rates[links..2 * links]);
        let slope = |link, angle| rates[system.state_index(angle, links + link)];
        (accelerations, DMatrix::from_fn(links, links, slope))
    }

    /// Returns the derivatives of the accelerations at the equilibrium that Newton's method reaches
    /// from the hanging tree; `None` if it does not converge.
    fn slopes_at_rest(&self, globals: &[f64]) -> Option<DMatrix<f64>> {
        let values = self.parameters(globals);
        let system = Sensitivities::new(self.family, self.dimension, &values, &[]);
        let mut angles = vec![0.0; self.dimension / 2];
        for _ in 0..STEPS_TO_REST {
            let (accelerations, slopes) = self.at_rest(&system, &angles);
            if !slopes.iter().all(|slope| slope.is_finite()) {
                return None;
            }
            // Links without restoring torque stay where they are.
            if accelerations.amax() == 0.0 {
                return Some(slopes);
            }
            let step = slopes.clone().lu().solve(&accelerations)?;
            let longest = step.amax();
            if longest <= AT_REST {
                return Some(slopes);
            }
            let part = (LONGEST_STEP / longest).min(1.0);
            for (angle, step) in angles.iter_mut().zip(&step) {
                *angle -= part * step;
            }
        }
        None
    }

    /// Returns the frequencies (Hz) of all oscillating modes without friction, ascending; `None` if
    /// there is no equilibrium.
    fn modes(&self, globals: &[f64]) -> Option<Vec<f64>> {
        let schur = Schur::try_new(-self.slopes_at_rest(globals)?, f64::EPSILON, 10_000)?;
        let squares: Vec<f64> = schur.complex_eigenvalues().iter().map(|v| v.re).collect();
        let fastest = squares.iter().copied().fold(0.0, f64::max);
        let turning = squares
            .iter()
            .filter(|square| **square > ROUNDING * fastest);
        let mut modes: Vec<f64> = turning
            .map(|square| square.sqrt() / core::f64::consts::TAU)
            .collect();
        modes.sort_by(f64::total_cmp);
        Some(modes)
    }

    /// Returns the frequencies of the model together with the measured ones.
    pub(super) fn fitted_frequencies(&self, globals: &[f64]) -> Option<Vec<FittedFrequency>> {
        if self.frequencies.is_empty() {
            return Some(Vec::new());
        }
        let modes = self.modes(globals)?;
        let fitted = |datum: &FrequencyDatum| {
            Some(FittedFrequency {
                mode: datum.place + 1,
                hertz: datum.hertz,
                deviation: datum.deviation,
                fitted: *modes.get(datum.place)?,
            })
        };
        self.frequencies.iter().map(fitted).collect()
    }

    /// Returns the frequencies of the model minus the data, in units of their standard errors,
    /// multiplied by `beside`, the error of the angles that are fitted together with them.
    pub(super) fn frequency_residuals(&self, globals: &[f64], beside: f64) -> Option<Vec<f64>> {
        let fitted = self.fitted_frequencies(globals)?;
        Some(fitted.iter().map(|own| beside * own.residual()).collect())
    }

    /// Returns the rows of the frequencies in the least-squares problem, for the given globals.
    /// They are difference quotients of frequencies and not derivatives of eigenvalues, so that
    /// equal frequencies need no special treatment.
    pub(super) fn frequency_rows(
        &self,
        globals: &[f64],
        free: &[usize],
        beside: f64,
    ) -> Option<DMatrix<f64>> {
        let count = free.len();
        let mut rows = DMatrix::zeros(self.frequencies.len(), count + 1);
        if self.frequencies.is_empty() {
            return Some(rows);
        }
        let residuals = self.frequency_residuals(globals, beside)?;
        for (row, residual) in residuals.iter().enumerate() {
            rows[(row, count)] = -residual;
        }
        for (column, &global) in free.iter().enumerate() {
            let moved = |step: f64| {
                let mut globals = globals.to_vec();
                globals[global] += step * self.scales[global];
                self.frequency_residuals(&globals, beside)
            };
            let (above, below) = (moved(STEP)?, moved(-STEP)?);
            for (row, (above, below)) in above.iter().zip(&below).enumerate() {
                rows[(row, column)] = (above - below) / (2.0 * STEP);
            }
        }
        Some(rows)
    }

    /// Assigns a mode of the tree to each measured frequency; `globals` are the unknown parameters,
    /// which determine the tree's modes.
    pub(super) fn assigned(
        &self,
        frequencies: &[Frequency],
        globals: &[f64],
    ) -> Result<Vec<FrequencyDatum>, IdentificationError> {
        if frequencies.is_empty() {
            return Ok(Vec::new());
        }
        for own in frequencies {
            let is_possible = |value: f64| value.is_finite() && value > 0.0;
            if !is_possible(own.hertz) || !is_possible(own.deviation) {
                return Err(IdentificationError::Frequency {
                    hertz: own.hertz,
                    deviation: own.deviation,
                });
            }
        }
        let modes = self.modes(globals).ok_or(IdentificationError::NoRest)?;
        let modes = modes.len();
        let unnumbered = frequencies.iter().filter(|own| own.mode.is_none()).count();
        if unnumbered > 0 && (unnumbered < frequencies.len() || unnumbered != modes) {
            return Err(IdentificationError::Unnumbered {
                unnumbered,
                frequencies: frequencies.len(),
                modes,
            });
        }
        let mut ascending: Vec<usize> = (0..frequencies.len()).collect();
        ascending.sort_by(|&a, &b| frequencies[a].hertz.total_cmp(&frequencies[b].hertz));
        let datum = |(index, own): (usize, &Frequency)| {
            let place = match own.mode {
                Some(mode) if (1..=modes).contains(&mode) => mode - 1,
                Some(mode) => return Err(IdentificationError::Mode { mode, modes }),
                None => ascending
                    .iter()
                    .take_while(|&&other| other != index)
                    .count(),
            };
            Ok(FrequencyDatum {
                place,
                hertz: own.hertz,
                deviation: own.deviation,
            })
        };
        frequencies.iter().enumerate().map(datum).collect()
    }
}
