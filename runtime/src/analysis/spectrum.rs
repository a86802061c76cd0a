//! Amplitude spectra of evenly sampled series.
//!
//! A sine of amplitude a and a frequency on the grid shows as a peak of height
//! a, in the units of the series. The transform is summed directly at each
//! frequency, so any frequencies may be asked for; N samples at F frequencies
//! take N·F steps.

use core::f64::consts::TAU;
use core::fmt;

/// Weights of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Window {
    /// All samples alike: the narrowest peaks, with wide side lobes.
    Rectangular,
    /// sin²(π n / N), periodic: peaks twice as wide, side lobes that fall off
    /// as the third power of the distance.
    #[default]
    Hann,
}

/// Options of a spectrum. By default the mean is removed and the window is that
/// of Hann.
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

/// Amplitudes at ascending frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Frequencies in hertz, ascending.
    pub frequencies_hz: Vec<f64>,
    /// Amplitude at each frequency, in the units of the series.
    pub amplitudes: Vec<f64>,
}

/// A maximum of a spectrum, refined between the frequencies of its grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Frequency in hertz.
    pub frequency_hz: f64,
    /// Amplitude, in the units of the series.
    pub amplitude: f64,
}

impl Spectrum {
    /// The spectrum at the Fourier frequencies k/(N Δt), k = 0 … ⌊N/2⌋, of N
    /// samples taken at `sample_rate_hz` = 1/Δt. N²/2 steps.
    ///
    /// # Errors
    ///
    /// As [`at_frequencies`](Self::at_frequencies).
    pub fn at_fourier_frequencies(
        samples: &[f64],
        sample_rate_hz: f64,
        options: SpectrumOptions,
    ) -> Result<Self, SpectrumError> {
        let count = samples.len();
        let frequencies: Vec<f64> = (0..=count / 2)
            .map(|k| k as f64 * sample_rate_hz / count as f64)
            .collect();
        Self::at_frequencies(samples, sample_rate_hz, &frequencies, options)
    }

    /// The spectrum at the given frequencies, in hertz, ascending. N·F steps
    /// for N samples and F frequencies.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`] for fewer than two samples, a sample that is not
    /// finite, a sample rate that is not finite and positive, frequencies that
    /// do not ascend or lie outside 0 to half the sample rate.
    ///
    /// # Examples
    ///
    /// ```
    /// use std::f64::consts::TAU;
    ///
    /// use branched_pendulum::analysis::{Spectrum, SpectrumOptions};
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
    /// # Ok::<(), branched_pendulum::analysis::SpectrumError>(())
    /// ```
    pub fn at_frequencies(
        samples: &[f64],
        sample_rate_hz: f64,
        frequencies_hz: &[f64],
        options: SpectrumOptions,
    ) -> Result<Self, SpectrumError> {
        check(samples, sample_rate_hz, frequencies_hz)?;
        let (weighted, weight) = prepare(samples, options);
        let nyquist = 0.5 * sample_rate_hz;
        let amplitudes = frequencies_hz
            .iter()
            .map(|&frequency| {
                // A real oscillation is split between +f and -f, which are one
                // at zero and at half the sample rate.
                let share = if frequency == 0.0 || frequency == nyquist {
                    1.0
                } else {
                    2.0
                };
                share * fourier_magnitude(&weighted, frequency / sample_rate_hz) / weight
            })
            .collect();
        Ok(Self {
            frequencies_hz: frequencies_hz.to_vec(),
            amplitudes,
        })
    }

    /// All maxima inside the range of frequencies, the highest first.
    ///
    /// Each is refined by the parabola through the logarithms of the three
    /// amplitudes around it. For a Hann window and a grid of Fourier frequencies
    /// this finds an isolated oscillation's frequency to a few hundredths of the
    /// grid's spacing and its amplitude to 4 %; a finer grid finds both closer.
    pub fn peaks(&self) -> Vec<Peak> {
        let mut peaks: Vec<Peak> = self
            .frequencies_hz
            .windows(3)
            .zip(self.amplitudes.windows(3))
            .filter_map(
                |(frequencies, amplitudes)| match (frequencies, amplitudes) {
                    (&[f0, f1, f2], &[a0, a1, a2]) if a1 > a0 && a1 >= a2 => {
                        Some(refine([f0, f1, f2], [a0, a1, a2]))
                    }
                    _ => None,
                },
            )
            .collect();
        peaks.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        peaks
    }
}

/// Vertex of the parabola through three points (frequency, log amplitude), the
/// middle one being the highest; the frequencies need not be evenly spaced.
fn refine([f0, f1, f2]: [f64; 3], [a0, a1, a2]: [f64; 3]) -> Peak {
    let unrefined = Peak {
        frequency_hz: f1,
        amplitude: a1,
    };
    if a0 <= 0.0 || a2 <= 0.0 {
        return unrefined;
    }
    let left = (a1 / a0).ln() / (f1 - f0);
    let right = (a2 / a1).ln() / (f2 - f1);
    let curvature = (right - left) / (f2 - f0);
    if curvature.is_nan() || curvature >= 0.0 {
        return unrefined;
    }
    // Newton form: log a = log a1 + slope (f - f1) + curvature (f - f1)^2.
    let slope = left + curvature * (f1 - f0);
    let shift = -slope / (2.0 * curvature);
    Peak {
        frequency_hz: f1 + shift,
        amplitude: a1 * (0.5 * slope * shift).exp(),
    }
}

fn check(samples: &[f64], rate: f64, frequencies: &[f64]) -> Result<(), SpectrumError> {
    if samples.len() < 2 {
        return Err(SpectrumError::TooFewSamples {
            found: samples.len(),
        });
    }
    if let Some((index, &value)) = samples.iter().enumerate().find(|(_, v)| !v.is_finite()) {
        return Err(SpectrumError::Sample { index, value });
    }
    if !(rate.is_finite() && rate > 0.0) {
        return Err(SpectrumError::SampleRate { value: rate });
    }
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

/// The samples times their weights, and the sum of the weights.
fn prepare(samples: &[f64], options: SpectrumOptions) -> (Vec<f64>, f64) {
    let count = samples.len() as f64;
    let mean = if options.remove_mean {
        samples.iter().sum::<f64>() / count
    } else {
        0.0
    };
    let weight = |index: usize| match options.window {
        Window::Rectangular => 1.0,
        Window::Hann => 0.5 * (1.0 - (TAU * index as f64 / count).cos()),
    };
    let weighted = samples
        .iter()
        .enumerate()
        .map(|(i, x)| weight(i) * (x - mean))
        .collect();
    (weighted, (0..samples.len()).map(weight).sum())
}

/// |Σ x_n exp(−2πi f n)| for f in cycles per sample.
fn fourier_magnitude(samples: &[f64], frequency: f64) -> f64 {
    // The phase advances by rotation, which is cheap but lets rounding grow;
    // each block starts from an exact phase, so that it does not.
    const BLOCK: usize = 64;
    let (rotate_sine, rotate_cosine) = (TAU * frequency).sin_cos();
    let (mut real, mut imaginary) = (0.0, 0.0);
    for (block, values) in samples.chunks(BLOCK).enumerate() {
        let turns = frequency * (block * BLOCK) as f64;
        let (mut sine, mut cosine) = (TAU * (turns - turns.floor())).sin_cos();
        for value in values {
            real += value * cosine;
            imaginary += value * sine;
            (sine, cosine) = (
                sine * rotate_cosine + cosine * rotate_sine,
                cosine * rotate_cosine - sine * rotate_sine,
            );
        }
    }
    real.hypot(imaginary)
}

/// Why a series has no spectrum.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SpectrumError {
    /// Fewer than two samples.
    TooFewSamples {
        /// Number of samples given.
        found: usize,
    },
    /// A sample is infinite or NaN.
    Sample {
        /// Index of the sample.
        index: usize,
        /// The sample.
        value: f64,
    },
    /// The sample rate is not finite and positive.
    SampleRate {
        /// The rate given, in hertz.
        value: f64,
    },
    /// A frequency is NaN or outside 0 to half the sample rate.
    Frequency {
        /// Index of the frequency.
        index: usize,
        /// The frequency, in hertz.
        value: f64,
        /// Half the sample rate, in hertz.
        nyquist: f64,
    },
    /// The frequencies do not ascend.
    FrequencyOrder {
        /// Index of the offending frequency.
        index: usize,
        /// The frequency before it, in hertz.
        previous: f64,
        /// The offending frequency, in hertz.
        value: f64,
    },
}

impl fmt::Display for SpectrumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewSamples { found } => {
                write!(f, "a spectrum needs at least two samples, but got {found}")
            }
            Self::Sample { index, value } => write!(f, "sample {index} is {value}"),
            Self::SampleRate { value } => {
                write!(
                    f,
                    "the sample rate is {value} Hz: it must be finite and positive"
                )
            }
            Self::Frequency {
                index,
                value,
                nyquist,
            } => write!(
                f,
                "frequency {index} is {value} Hz: it must be between 0 and {nyquist} Hz, \
                 half the sample rate"
            ),
            Self::FrequencyOrder {
                index,
                previous,
                value,
            } => write!(
                f,
                "frequency {index} is {value} Hz, after {previous} Hz: frequencies must ascend"
            ),
        }
    }
}

impl core::error::Error for SpectrumError {}
