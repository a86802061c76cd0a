//! Why there is no curve.

use crate::errors::errors;
use crate::integrate::IntegrationError;

errors! {
    /// Why the error of truncated forms could not be found.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum TruncationError {
        /// The model has no exact form of W to compare with.
        NoExactForm => "the model has no exact form of W to compare with",
        /// As many numbers as the model has coordinates are needed.
        Length {
            /// The quantity that the numbers are.
            what: &'static str,
            /// Number of coordinates.
            expected: usize,
            /// Number given.
            found: usize,
        } => "{what}: the model has {expected} coordinates, but got {found} numbers",
        /// A number that is not usable: amplitudes and rates of sampling must be
        /// positive, bounds not negative, all of them finite.
        Value {
            /// The quantity.
            what: &'static str,
            /// Value of the quantity.
            value: f64,
        } => "{what} cannot be {value}",
        /// Amplitudes do not grow.
        Order {
            /// An amplitude, rad.
            before: f64,
            /// The one after it, rad.
            after: f64,
        } => "amplitudes must grow, but {after} rad stands behind {before} rad",
        /// The differences of a sector do not oscillate about the hanging tree, so
        /// that they have no amplitude.
        NoFrequency {
            /// Name of the sector.
            sector: String,
            /// Mean square of its angular frequencies, 1/s².
            square: f64,
        } => "the differences of sector `{sector}` do not oscillate: the mean square of their \
            angular frequencies is {square} 1/s²",
        /// A motion could not be followed to its end.
        Integration(error: IntegrationError<f64>) => "a motion was not followed to its end",
    }
}

impl core::error::Error for TruncationError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Integration(error) => Some(error),
            _ => None,
        }
    }
}

impl From<IntegrationError<f64>> for TruncationError {
    fn from(error: IntegrationError<f64>) -> Self {
        Self::Integration(error)
    }
}

/// Passes numbers, one for each coordinate, of which none is negative.
pub(super) fn check_bounds(
    what: &'static str,
    expected: usize,
    values: &[f64],
) -> Result<(), TruncationError> {
    check_length(what, expected, values)?;
    let wrong = values
        .iter()
        .find(|value| !(value.is_finite() && **value >= 0.0));
    match wrong {
        Some(&value) => Err(TruncationError::Value { what, value }),
        None => Ok(()),
    }
}

/// Passes numbers, one for each coordinate.
pub(super) fn check_length(
    what: &'static str,
    expected: usize,
    values: &[f64],
) -> Result<(), TruncationError> {
    let found = values.len();
    if found == expected {
        return Ok(());
    }
    Err(TruncationError::Length {
        what,
        expected,
        found,
    })
}

/// Passes a positive finite number.
pub(super) fn check_positive(what: &'static str, value: f64) -> Result<(), TruncationError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(TruncationError::Value { what, value })
}

/// Passes positive amplitudes that grow.
pub(super) fn check_amplitudes(amplitudes: &[f64]) -> Result<(), TruncationError> {
    for &amplitude in amplitudes {
        check_positive("an amplitude", amplitude)?;
    }
    for pair in amplitudes.windows(2) {
        if let [before, after] = *pair
            && before >= after
        {
            return Err(TruncationError::Order { before, after });
        }
    }
    Ok(())
}
