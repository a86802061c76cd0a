//! Spectra of successive time intervals of a record.

use super::error::{SpectrumError, check};

/// Division of a record into time intervals, for motions whose frequencies change, such as damped
/// ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passages {
    /// Length of a stretch, s.
    pub span: f64,
    /// Time between the starts of two successive intervals, in s.
    pub step: f64,
}

/// The spectrum or the lines of one time interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage<T> {
    /// Time from the first sample of the record to the middle of the interval, in s.
    pub middle: f64,
    /// Spectrum or lines of the interval.
    pub found: T,
}

impl Passages {
    /// Applies `find` to each interval of samples taken at `sample_rate_hz` (Hz), and returns the
    /// results: spectra, for a spectrogram, or lines.
    ///
    /// # Errors
    ///
    /// Errors of `find`; [`SpectrumError`] for samples without a spectrum, and for spans and
    /// steps shorter than a sample.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum_measure::{LineSearch, Passages};
    ///
    /// // A frequency that falls by 0.01 Hz a second.
    /// let phase = |t: f64| std::f64::consts::TAU * (2.0 * t - 0.005 * t * t);
    /// let samples: Vec<f64> = (0..3000).map(|i| phase(0.01 * f64::from(i)).sin()).collect();
    /// let passages = Passages { span: 10.0, step: 10.0 };
    /// let found = passages.each(&samples, 100.0, |part| LineSearch::default().find(part, 100.0))?;
    /// assert_eq!(found.len(), 3);
    /// let middle = &found[1];
    /// assert!((middle.found.lines[0].frequency_hz - (2.0 - 0.01 * middle.middle)).abs() < 1e-3);
    /// # Ok::<(), branched_pendulum_measure::SpectrumError>(())
    /// ```
    pub fn each<T>(
        &self,
        samples: &[f64],
        sample_rate_hz: f64,
        mut find: impl FnMut(&[f64]) -> Result<T, SpectrumError>,
    ) -> Result<Vec<Passage<T>>, SpectrumError> {
        check(samples, sample_rate_hz)?;
        let rate = sample_rate_hz;
        for (name, value) in [("span", self.span), ("step", self.step)] {
            if !(value.is_finite() && value * rate >= 1.0) {
                return Err(SpectrumError::Option { name, value });
            }
        }
        let length = (self.span * rate).round() as usize;
        let mut passages = Vec::new();
        for index in 0.. {
            // Rounds each start separately, so that errors of steps that are no whole number of
            // samples do not accumulate.
            let start = (index as f64 * self.step * rate).round() as usize;
            let Some(part) = samples.get(start..start.saturating_add(length)) else {
                break;
            };
            passages.push(Passage {
                middle: (start as f64 + 0.5 * (length - 1) as f64) / rate,
                found: find(part)?,
            });
        }
        Ok(passages)
    }
}
