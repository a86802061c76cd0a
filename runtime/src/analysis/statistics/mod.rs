//! Time averages of fluctuating motions, with reliable error bars.
//!
//! Successive samples of a motion are correlated: n of them have the error of n/τ independent ones,
//! with the autocorrelation time τ. [`Average`] computes τ from the autocorrelation; [`Blocking`]
//! computes the same error by another method, as a check. Both accept several series, from
//! independent starts, as one ensemble with a common mean.
//!
//! An average needs a steady state: [`transient`] finds where it begins, and [`Drift`] tests that
//! it has begun. Series that have not settled, or that are too short for their correlations, give
//! an error instead of a number. [`jackknife`] gives errors of quantities that are not averages:
//! ratios, slopes, skewness.

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

/// Returns the number of samples of all series; an error if it is below `needed` or if a sample is
/// not finite.
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

/// Returns the mean of all samples.
fn mean<S: AsRef<[f64]>>(series: &[S], samples: usize) -> f64 {
    let sums = series
        .iter()
        .map(|values| values.as_ref().iter().sum::<f64>());
    sums.sum::<f64>() / samples as f64
}
