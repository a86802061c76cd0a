//! Errors in the computation of spectra.

use thiserror::Error;

/// Reason why a spectrum of a series could not be computed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpectrumError {
    /// There are fewer than two samples.
    #[error("a spectrum needs at least two samples, but got {found}")]
    TooFewSamples {
        /// Number of samples given.
        found: usize,
    },
    /// A sample is infinite or NaN.
    #[error("sample {index} is {value}: samples must be finite")]
    Sample {
        /// Index of the sample.
        index: usize,
        /// Value of the sample.
        value: f64,
    },
    /// The sample rate is not finite and positive.
    #[error("the sample rate is {value} Hz: it must be finite and positive")]
    SampleRate {
        /// The sample rate given, Hz.
        value: f64,
    },
    /// A frequency is NaN or outside 0 to half the sample rate.
    #[error(
        "frequency {index} is {value} Hz: it must be between 0 and {nyquist} Hz, half the sample rate"
    )]
    Frequency {
        /// Index of the frequency.
        index: usize,
        /// Value of the frequency, Hz.
        value: f64,
        /// Half the sample rate, Hz.
        nyquist: f64,
    },
    /// An option of a search for lines is outside its range.
    #[error("the {name} is {value}, outside of its accepted range")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// The frequencies do not ascend.
    #[error("frequency {index} is {value} Hz, after {previous} Hz: frequencies must ascend")]
    FrequencyOrder {
        /// Index of the frequency that is not larger than the one before.
        index: usize,
        /// The frequency before it, Hz.
        previous: f64,
        /// Value of that frequency, Hz.
        value: f64,
    },
}

/// Checks that there are enough samples, that they are finite, and that the rate is finite and
/// positive.
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
