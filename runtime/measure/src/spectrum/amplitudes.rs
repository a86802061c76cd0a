//! Amplitudes against frequency.

use super::error::{SpectrumError, check};
use super::transform::{at_frequency, at_grid};
use super::window::Window;

/// Options of a spectrum. The default subtracts the mean and uses Hann's window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpectrumOptions {
    /// True if the mean of the samples is subtracted first.
    pub remove_mean: bool,
    /// Weights of the samples; amplitudes are corrected for their sum.
    pub window: Window,
}

impl Default for SpectrumOptions {
    fn default() -> Self {
        Self {
            remove_mean: true,
            window: Window::default(),
        }
    }
}

/// Amplitudes at ascending frequencies. A sine of amplitude a at one of these frequencies gives a
/// peak of height a, in the units of the series.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Frequencies, Hz, ascending.
    pub frequencies_hz: Vec<f64>,
    /// Amplitude at each frequency, in the units of the series.
    pub amplitudes: Vec<f64>,
}

impl Spectrum {
    /// Returns the spectrum at the Fourier frequencies k/(N Δt), k = 0 … ⌊N/2⌋, of N
    /// samples taken at `sample_rate_hz` = 1/Δt, by a fast transform.
    ///
    /// # Errors
    ///
    /// As [`at_frequencies`](Self::at_frequencies).
    pub fn at_fourier_frequencies(
        samples: &[f64],
        sample_rate_hz: f64,
        options: SpectrumOptions,
    ) -> Result<Self, SpectrumError> {
        check(samples, sample_rate_hz)?;
        let (weighted, weight) = options.prepare(samples);
        let count = samples.len();
        let magnitudes = at_grid(&weighted, count);
        let shares = (0..magnitudes.len()).map(|k| share(k == 0 || 2 * k == count));
        Ok(Self {
            frequencies_hz: (0..magnitudes.len())
                .map(|k| k as f64 * sample_rate_hz / count as f64)
                .collect(),
            amplitudes: magnitudes
                .iter()
                .zip(shares)
                .map(|(magnitude, share)| share * magnitude / weight)
                .collect(),
        })
    }

    /// Returns the spectrum at the given frequencies, Hz, ascending. The effort is N·F steps for N
    /// samples and F frequencies.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`] for fewer than two samples, a sample that is not finite, a sample rate
    /// that is not finite and positive, or frequencies that do not ascend or are outside 0 to half
    /// the sample rate.
    ///
    /// # Examples
    ///
    /// ```
    /// use std::f64::consts::TAU;
    ///
    /// use branched_pendulum_measure::{Spectrum, SpectrumOptions};
    ///
    /// let samples: Vec<f64> =
    ///     (0..400).map(|i| 0.3 * (TAU * 1.25 * 0.02 * f64::from(i)).sin()).collect();
    /// let spectrum = Spectrum::at_frequencies(
    ///     &samples,
    ///     50.0,
    ///     &[1.0, 1.25, 1.5],
    ///     SpectrumOptions::default(),
    /// )?;
    /// assert!((spectrum.amplitudes[1] - 0.3).abs() < 1e-12);
    /// # Ok::<(), branched_pendulum_measure::SpectrumError>(())
    /// ```
    pub fn at_frequencies(
        samples: &[f64],
        sample_rate_hz: f64,
        frequencies_hz: &[f64],
        options: SpectrumOptions,
    ) -> Result<Self, SpectrumError> {
        check(samples, sample_rate_hz)?;
        check_frequencies(sample_rate_hz, frequencies_hz)?;
        let (weighted, weight) = options.prepare(samples);
        let nyquist = 0.5 * sample_rate_hz;
        let amplitude = |&frequency: &f64| {
            let share = share(frequency == 0.0 || frequency == nyquist);
            share * at_frequency(&weighted, frequency / sample_rate_hz) / weight
        };
        Ok(Self {
            frequencies_hz: frequencies_hz.to_vec(),
            amplitudes: frequencies_hz.iter().map(amplitude).collect(),
        })
    }
}

/// Returns the factor that converts the magnitude of a Fourier sum to an amplitude. A real
/// oscillation is divided between +f and −f, which coincide at zero and at half the sample rate.
fn share(is_one: bool) -> f64 {
    if is_one { 1.0 } else { 2.0 }
}

fn check_frequencies(rate: f64, frequencies: &[f64]) -> Result<(), SpectrumError> {
    let mut previous = 0.0;
    for (index, &value) in frequencies.iter().enumerate() {
        if !(0.0..=0.5 * rate).contains(&value) {
            return Err(SpectrumError::Frequency {
                index,
                value,
                nyquist: 0.5 * rate,
            });
        }
        if index > 0 && value <= previous {
            return Err(SpectrumError::FrequencyOrder {
                index,
                previous,
                value,
            });
        }
        previous = value;
    }
    Ok(())
}

impl SpectrumOptions {
    /// Returns the samples multiplied by their weights, and the sum of the weights.
    fn prepare(&self, samples: &[f64]) -> (Vec<f64>, f64) {
        let mean = if self.remove_mean {
            samples.iter().sum::<f64>() / samples.len() as f64
        } else {
            0.0
        };
        let weights = self.window.weights(samples.len());
        let weighted = samples.iter().zip(&weights).map(|(x, w)| w * (x - mean));
        (weighted.collect(), weights.iter().sum())
    }
}
