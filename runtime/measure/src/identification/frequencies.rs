//! Frequencies of small motions, as data beside trajectories or in place of them.

use nalgebra::{DMatrix, DVector, Schur};

use super::error::IdentificationError;
use super::fit::FittedFrequency;
use super::sensitivity::Sensitivities;
use super::task::{FitTask, FrequencyDatum};
use branched_pendulum::system::Ode;

/// A measured frequency of a small motion about rest.
///
/// Modes are those without friction: what is viscous lowers a frequency by the share ζ²/2, with ζ
/// the damping ratio, and dry friction does not. A drive acts as at time 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// The frequency, Hz.
    pub hertz: f64,
    /// Standard error of the frequency, Hz.
    pub deviation: f64,
    /// Number of its mode, 1 for the slowest of those that oscillate. Frequencies of which none
    /// has a number are as many as these modes, and belong to them in ascending order.
    pub mode: Option<usize>,
}

/// Relative step of the difference quotients: their error is its square.
const STEP: f64 = 1e-5;
/// Steps to the place of rest at most, the largest of one, and that after which there is none, rad.
const STEPS_TO_REST: usize = 100;
const LONGEST_STEP: f64 = 0.5;
const AT_REST: f64 = 1e-12;
/// Part of the square of the fastest mode's rate below which one does not oscillate.
const ROUNDING: f64 = 1e-12;

impl FitTask<'_> {
    /// Accelerations of links that rest at these angles, and their slopes by the angles.
    fn at_rest(&self, system: &Sensitivities<'_>, angles: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        let links = angles.len();
        let mut state = angles.to_vec();
        state.resize(2 * links, 0.0);
        let start = system.start(&state);
        let mut rates = vec![0.0; start.len()];
        system.rates(0.0, &start, &mut rates);
        let accelerations = DVector::from_column_slice(&rates[links..2 * links]);
        let slope = |link, angle| rates[system.place(angle, links + link)];
        (accelerations, DMatrix::from_fn(links, links, slope))
    }

    /// Slopes of the accelerations at the place of rest that Newton's steps reach from hanging;
    /// none where they reach none.
    fn slopes_at_rest(&self, globals: &[f64]) -> Option<DMatrix<f64>> {
        let values = self.parameters(globals);
        let system = Sensitivities::new(self.family, self.dimension, &values, &[]);
        let mut angles = vec![0.0; self.dimension / 2];
        for _ in 0..STEPS_TO_REST {
            let (accelerations, slopes) = self.at_rest(&system, &angles);
            if !slopes.iter().all(|slope| slope.is_finite()) {
                return None;
            }
            // Links that nothing turns back stay where they are.
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

    /// Frequencies (Hz) of all modes that oscillate without friction, from the slowest on; none
    /// where the tree comes to no rest.
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

    /// Frequencies of the model beside the data.
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

    /// Frequencies less data: in standard errors, times the errors of the angles beside which
    /// they stand.
    pub(super) fn frequency_residuals(&self, globals: &[f64], beside: f64) -> Option<Vec<f64>> {
        let fitted = self.fitted_frequencies(globals)?;
        Some(fitted.iter().map(|own| beside * own.residual()).collect())
    }

    /// Rows on these globals and what they have to make up for. Differences of frequencies,
    /// not derivatives of eigenvalues, so that equal ones are no special case.
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

    /// Finds the mode of each frequency, with these globals.
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
