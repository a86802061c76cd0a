//! Start of a steady state: where it begins in a series, and a test that it has begun.

use super::average::Average;
use super::{StatisticsError, check};

/// Number of samples that are averaged before the transient is searched for.
const BATCH: usize = 5;

/// Returns the number of samples to leave out before the state is steady: the number d, at most
/// half of the n samples, for which the standard error of the mean of the others is smallest, Σ_{i
/// ≥ d} (x_i − x̄)²/(n − d)². It works on means of five samples each (MSER-5: K. P. White,
/// *Simulation* 69, 323, 1997).
///
/// The energy averaged over independent starts is a good series for this: its transient is the
/// longest, and averaging shows it most clearly.
///
/// # Errors
/// [`StatisticsError::Unsettled`] if the smallest error is at half of the samples, so that the
/// series is still in its transient; `TooFew` for fewer than 50 samples, `NotFinite` if one is not
/// finite.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::statistics::{StatisticsError, transient};
///
/// let settling = |i: i32| (-f64::from(i) / 30.0).exp() + 0.02 * (2.4 * f64::from(i)).sin();
/// let series: Vec<f64> = (0..1000).map(settling).collect();
/// assert!((60..250).contains(&transient(&series)?));
/// assert_eq!(transient(&series[..60]), Err(StatisticsError::Unsettled));
/// # Ok::<(), StatisticsError>(())
/// ```
pub fn transient(series: &[f64]) -> Result<usize, StatisticsError> {
    check(&[series], 10 * BATCH)?;
    let batches: Vec<f64> = series
        .chunks_exact(BATCH)
        .map(|batch| batch.iter().sum::<f64>() / BATCH as f64)
        .collect();
    let half = batches.len() / 2;
    let mut least = (f64::INFINITY, 0);
    // Computes Welford's sums from the end, so that nothing cancels.
    let (mut mean, mut squares) = (0.0, 0.0);
    for (start, value) in batches.iter().enumerate().rev() {
        let number = (batches.len() - start) as f64;
        let deviation = value - mean;
        mean += deviation / number;
        squares += deviation * (value - mean);
        let statistic = squares / (number * number);
        if start <= half && statistic <= least.0 {
            least = (statistic, start);
        }
    }
    match least.1 {
        start if start == half => Err(StatisticsError::Unsettled),
        start => Ok(BATCH * start),
    }
}

/// The change of an average between the two halves of the time.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::statistics::Drift;
///
/// let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65_536.0;
/// let steady: Vec<f64> = (0..1000).map(noise).collect();
/// assert!(Drift::of(&[&steady])?.is_within(2.0));
/// let heated: Vec<f64> = (0..1000).map(|i| noise(i) + 2e-4 * f64::from(i)).collect();
/// assert!(!Drift::of(&[&heated])?.is_within(2.0));
/// # Ok::<(), branched_pendulum::analysis::statistics::StatisticsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// Mean of the second half minus that of the first.
    pub change: f64,
    /// Standard error of the change.
    pub error: f64,
}

impl Drift {
    /// Returns the drift of series of one quantity, sampled at equal intervals. The series are from
    /// independent starts.
    ///
    /// # Errors
    /// As [`Average::of`] for each half: a series that is too short for an average is not steady
    /// either.
    pub fn of<S: AsRef<[f64]>>(series: &[S]) -> Result<Self, StatisticsError> {
        let halves = series.iter().map(|values| {
            let values = values.as_ref();
            values.split_at(values.len() / 2)
        });
        let (first, second): (Vec<_>, Vec<_>) = halves.unzip();
        let (first, second) = (Average::of(&first)?, Average::of(&second)?);
        Ok(Self {
            change: second.mean - first.mean,
            error: first.error.hypot(second.error),
        })
    }

    /// Returns true if the absolute change is at most `bars` standard errors.
    pub fn is_within(&self, bars: f64) -> bool {
        self.change.abs() <= bars * self.error
    }
}
