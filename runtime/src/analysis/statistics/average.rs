//! Averages with errors from the integrated autocorrelation time.

use super::{StatisticsError, check, mean};

/// Autocorrelation below which the summation over lags ends.
const LEAST_CORRELATION: f64 = 0.05;

/// Smallest length of a series, in correlation times, for which an average is returned.
const FEWEST_TIMES: f64 = 8.0;

/// The average of a quantity over time and over independent starts, with its error.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::statistics::Average;
///
/// // A deviation of 1 that loses a fifth at each sample, pushed by ±0.6.
/// let mut value = 0.0_f64;
/// let mut random = 1_u64;
/// let series: Vec<f64> = (0..20_000)
///     .map(|_| {
///         random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
///         value = 0.8 * value + if random >> 63 == 1 { 0.6 } else { -0.6 };
///         value
///     })
///     .collect();
/// let average = Average::of(&[&series])?;
/// assert!((average.correlation_time - 9.0).abs() < 2.0);
/// assert!((average.error / (9.0_f64 / 20_000.0).sqrt() - 1.0).abs() < 0.1);
/// assert!(average.mean.abs() < 3.0 * average.error);
/// # Ok::<(), branched_pendulum::analysis::statistics::StatisticsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Average {
    /// Mean of all samples.
    pub mean: f64,
    /// Standard error of the mean.
    pub error: f64,
    /// Standard deviation of the samples.
    pub deviation: f64,
    /// Integrated autocorrelation time τ, in samples: 1 if the samples are independent.
    pub correlation_time: f64,
    /// Number of samples.
    pub samples: usize,
}

impl Average {
    /// Returns the average of series of one quantity, sampled at equal intervals in a steady state.
    /// The series are from independent starts.
    ///
    /// The autocorrelation ρ is that of all series about their common mean, so that series that
    /// stay apart do not count as independent samples; τ = 1 + 2 Σ ρ over the lags before the first
    /// with ρ < 0.05; the error is σ √(τ/n). (N. Madras and A. D. Sokal, *Journal of Statistical
    /// Physics* 50, 109, 1988.)
    ///
    /// # Errors
    /// [`StatisticsError`]; `Correlated` if ρ stays above 0.05 up to half of the longest series, or
    /// if n is below 8 τ.
    pub fn of<S: AsRef<[f64]>>(series: &[S]) -> Result<Self, StatisticsError> {
        let samples = check(series, 2)?;
        let mean = mean(series, samples);
        if !fluctuates(series) {
            // The variance of equal samples would be that of the mean's rounding.
            return Ok(Self {
                mean,
                error: 0.0,
                deviation: 0.0,
                correlation_time: 1.0,
                samples,
            });
        }
        let variance = covariance(series, mean, 0);
        let longest = series.iter().map(|values| values.as_ref().len()).max();
        let farthest = longest.unwrap_or(0) / 2;
        let mut time = 1.0;
        let mut lag = 1;
        loop {
            if lag > farthest {
                return Err(StatisticsError::Correlated { samples, lag });
            }
            let correlation = covariance(series, mean, lag) / variance;
            if correlation < LEAST_CORRELATION {
                break;
            }
            time += 2.0 * correlation;
            lag += 1;
        }
        let number = samples as f64;
        if number < FEWEST_TIMES * time {
            return Err(StatisticsError::Correlated { samples, lag });
        }
        // Corrects the variance: deviations from the mean of the samples are smaller than from the
        // true mean, by the factor 1 − τ/n.
        let variance = variance / (1.0 - time / number);
        Ok(Self {
            mean,
            error: (variance * time / number).sqrt(),
            deviation: variance.sqrt(),
            correlation_time: time,
            samples,
        })
    }

    /// Returns the number of independent samples with the same error, n/τ.
    pub fn independent(&self) -> f64 {
        self.samples as f64 / self.correlation_time
    }
}

/// Returns true unless all samples are equal.
fn fluctuates<S: AsRef<[f64]>>(series: &[S]) -> bool {
    let mut samples = series.iter().flat_map(|values| values.as_ref());
    let first = samples.next();
    samples.any(|sample| Some(sample) != first)
}

/// Returns the mean product of deviations from `mean` that are `lag` samples apart.
fn covariance<S: AsRef<[f64]>>(series: &[S], mean: f64, lag: usize) -> f64 {
    let (mut sum, mut number) = (0.0, 0_usize);
    for values in series.iter().map(AsRef::as_ref) {
        let later = values.get(lag..).unwrap_or_default();
        number += later.len();
        for (one, other) in values.iter().zip(later) {
            sum += (one - mean) * (other - mean);
        }
    }
    sum / number.max(1) as f64
}
