//! Time averages of fluctuating motions, with error bars that can be trusted.
//!
//! Successive samples of a motion are alike: n of them are worth n/τ independent
//! ones. [`Average`] finds τ from the autocorrelation, [`Blocking`] reaches the same
//! error by another way, as a check. Both take several series, from
//! independent starts, as one ensemble with a common mean.
//!
//! An average belongs to a steady state: [`transient`] finds where that begins, and
//! [`Drift`] tests that it has begun at all. Both can say no: a series that has not
//! settled, or that is too short for its own correlations, is an error and no number.
//! [`jackknife`] gives bars to what is no average: ratios, slopes, skewness.

mod average;
mod blocking;
mod error;
mod jackknife;
mod transient;

pub use average::Average;
pub use blocking::{BlockLevel, Blocking};
pub use error::StatisticsError;
pub use jackknife::{Estimate, jackknife};
pub use transient::{Drift, transient};

/// Checks series, and returns the number of their samples.
fn check<S: AsRef<[f64]>>(series: &[S], needed: usize) -> Result<usize, StatisticsError> {
    let mut found = 0;
    for (number, values) in series.iter().enumerate() {
        let values = values.as_ref();
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(StatisticsError::NotFinite {
                series: number,
                index,
            });
        }
        found += values.len();
    }
    if found < needed {
        return Err(StatisticsError::TooFew { found, needed });
    }
    Ok(found)
}

/// Mean of all samples.
fn mean<S: AsRef<[f64]>>(series: &[S], samples: usize) -> f64 {
    let sums = series
        .iter()
        .map(|values| values.as_ref().iter().sum::<f64>());
    sums.sum::<f64>() / samples as f64
}
