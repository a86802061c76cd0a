//! Why a series has no spectrum.

use thiserror::Error;

/// Why a series has no spectrum.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpectrumError {
    /// Fewer than two samples.
    #[error("a spectrum needs at least two samples, but got {found}")]
    TooFewSamples {
        /// Number of samples given.
        found: usize,
    },
    /// A sample is infinite or NaN.
    #[error("sample {index} is {value}")]
    Sample {
        /// Index of the sample.
        index: usize,
        /// The sample.
        value: f64,
    },
    /// The sample rate is not finite and positive.
    #[error("the sample rate is {value} Hz: it must be finite and positive")]
    SampleRate {
        /// The rate given, in hertz.
        value: f64,
    },
    /// A frequency is NaN or outside 0 to half the sample rate.
    #[error(
        "frequency {index} is {value} Hz: it must be between 0 and {nyquist} Hz, half the sample rate"
    )]
    Frequency {
        /// Index of the frequency.
        index: usize,
        /// The frequency, in hertz.
        value: f64,
        /// Half the sample rate, in hertz.
        nyquist: f64,
    },
    /// An option of a search for lines that is not possible.
    #[error("the {name} of {value} is not possible")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// The frequencies do not ascend.
    #[error("frequency {index} is {value} Hz, after {previous} Hz: frequencies must ascend")]
    FrequencyOrder {
        /// Index of the offending frequency.
        index: usize,
        /// The frequency before it, in hertz.
        previous: f64,
        /// The offending frequency, in hertz.
        value: f64,
    },
}

/// Refuses samples of which there is no spectrum.
pub(super) fn check(samples: &[f64], rate: f64) -> Result<(), SpectrumError> {
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
    Ok(())
}
