//! Where a steady state begins, and the test that it has begun.

use super::average::Average;
use super::{StatisticsError, check};

/// Samples that are averaged before a transient is looked for.
const BATCH: usize = 5;

/// Number of samples to leave out before the state is steady: the number d, at most
/// half of them, that makes the standard error of the mean of the rest least, Σ_{i ≥ d} (x_i − x̄)²/(n − d)²,
/// by batches of five samples (MSER-5: K. P. White, *Simulation* 69, 323, 1997).
///
/// Take the energy, averaged over independent starts: its transient is the longest, and
/// the average shows it best.
///
/// # Errors
/// [`StatisticsError::Unsettled`] where the least lies at the half: the series is still
/// in its transient; or fewer than 50 samples, or one that is not finite.
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
    // Welford's sums, from the end, so that nothing cancels.
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
    /// Mean of the second half less that of the first.
    pub change: f64,
    /// Standard error of the change.
    pub error: f64,
}

impl Drift {
    /// The drift of series of one quantity at even times, each from a start of its own.
    ///
    /// # Errors
    /// As [`Average::of`] of each half: what is too short to have an average is not
    /// steady either.
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

    /// True if the change is no larger than so many of its standard errors.
    pub fn is_within(&self, bars: f64) -> bool {
        self.change.abs() <= bars * self.error
    }
}
