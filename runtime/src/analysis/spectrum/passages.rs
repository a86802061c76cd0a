//! Spectra of one stretch of time after the other.

use super::amplitudes::{Spectrum, SpectrumOptions};
use super::error::{SpectrumError, check};
use super::lines::{LineSearch, Lines};

/// Stretches of a record, for motions whose frequencies change: those that friction damps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passages {
    /// Length of each, s.
    pub span: f64,
    /// Time from the start of one to that of the next, s.
    pub step: f64,
}

/// Lines found in one stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage<T> {
    /// Time from the first sample of the record to the middle of the stretch, s.
    pub middle: f64,
    /// Spectrum or lines of the stretch.
    pub found: T,
}

impl Passages {
    /// Returns the spectrum of each stretch at given frequencies: a spectrogram.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`], as [`Spectrum::at_frequencies`].
    pub fn spectra(
        &self,
        samples: &[f64],
        sample_rate_hz: f64,
        frequencies_hz: &[f64],
        options: SpectrumOptions,
    ) -> Result<Vec<Passage<Spectrum>>, SpectrumError> {
        self.each(samples, sample_rate_hz, |part| {
            Spectrum::at_frequencies(part, sample_rate_hz, frequencies_hz, options)
        })
    }

    /// Returns the lines of each stretch.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`], as [`LineSearch::find`].
    pub fn lines(
        &self,
        samples: &[f64],
        sample_rate_hz: f64,
        search: &LineSearch,
    ) -> Result<Vec<Passage<Lines>>, SpectrumError> {
        self.each(samples, sample_rate_hz, |part| {
            search.find(part, sample_rate_hz)
        })
    }

    fn each<T>(
        &self,
        samples: &[f64],
        rate: f64,
        mut find: impl FnMut(&[f64]) -> Result<T, SpectrumError>,
    ) -> Result<Vec<Passage<T>>, SpectrumError> {
        check(samples, rate)?;
        for (name, value) in [("span", self.span), ("step", self.step)] {
            if !(value.is_finite() && value * rate >= 1.0) {
                return Err(SpectrumError::Option { name, value });
            }
        }
        let length = (self.span * rate).round() as usize;
        let mut passages = Vec::new();
        for index in 0.. {
            // Rounded each by itself: steps that are no whole samples do not add up.
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
