//! Standard errors of quantities that are not plain averages, by the jackknife.

use super::StatisticsError;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimated value.
    pub value: f64,
    /// Standard error of the value.
    pub error: f64,
}

impl Estimate {
    /// Returns the mean of independent values with its standard error √(s²/k), where s² is the
    /// variance of the k values. The error of a single value is NaN.
    #[must_use]
    pub fn of_independent(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let value = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|other| (other - value).powi(2)).sum();
        Self {
            value,
            error: (squares / (count * (count - 1.0))).sqrt(),
        }
    }
}

/// Returns the value of any function of an ensemble with its jackknife error, computed by leaving
/// out each of its `members` in turn: √((k − 1)/k Σ (f_i − f̄)²).
///
/// `function(None)` is the value for all members, `function(Some(i))` for all except member i.
/// Members must be independent of each other: starts, or blocks much longer than the correlation
/// time.
///
/// # Errors
/// [`StatisticsError::TooFew`] for fewer than four members, `NotFinite` if the function returns a
/// value that is not finite.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::statistics::jackknife;
///
/// let values = [1.0, 2.0, 4.0, 3.0, 5.0];
/// let mean = jackknife(values.len(), |left_out| {
///     let kept = values.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
///     let kept: Vec<f64> = kept.map(|(_, value)| *value).collect();
///     kept.iter().sum::<f64>() / kept.len() as f64
/// })?;
/// assert_eq!(mean.value, 3.0);
/// assert!((mean.error - 0.5_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), branched_pendulum::analysis::statistics::StatisticsError>(())
/// ```
pub fn jackknife(
    members: usize,
    function: impl Fn(Option<usize>) -> f64,
) -> Result<Estimate, StatisticsError> {
    if members < 4 {
        return Err(StatisticsError::TooFew {
            found: members,
            needed: 4,
        });
    }
    let value = function(None);
    let others: Vec<f64> = (0..members).map(|member| function(Some(member))).collect();
    if let Some(series) = others.iter().position(|other| !other.is_finite()) {
        return Err(StatisticsError::NotFinite { series, index: 0 });
    }
    let number = members as f64;
    let mean = others.iter().sum::<f64>() / number;
    let squares: f64 = others.iter().map(|other| (other - mean).powi(2)).sum();
    Ok(Estimate {
        value,
        error: ((number - 1.0) / number * squares).sqrt(),
    })
}
