//! Errors in the computation of the accuracy of approximations of W.

use crate::errors::errors;
use crate::integrate::IntegrationError;

errors! {
    /// Reason why the errors of the truncated forms of W could not be computed.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum TruncationError {
        /// The model has no exact form of the energy transfer W to compare with.
        NoExactForm => "the model has no exact form of W to compare with",
        /// The number of values given is not the number of coordinates.
        Length {
            /// Name of the quantity whose values were given.
            what: &'static str,
            /// Number of coordinates.
            expected: usize,
            /// Number of values given.
            found: usize,
        } => "{what} must have one number for each of the {expected} coordinates, but have {found}",
        /// A value is invalid: amplitudes and sampling rates must be positive, bounds must not be
        /// negative, and all must be finite.
        Value {
            /// Name of the quantity.
            what: &'static str,
            /// Value of the quantity.
            value: f64,
        } => "{what} cannot be {value}",
        /// The amplitudes are not ascending.
        Order {
            /// An amplitude, rad.
            before: f64,
            /// The next amplitude, which must be larger but is not, in rad.
            after: f64,
        } => "amplitudes must ascend, but {after} rad follows {before} rad",
        /// The differences of a sector do not oscillate about the hanging tree, so that their
        /// amplitude is not defined.
        NoFrequency {
            /// Name of the sector.
            sector: String,
            /// Mean square of the angular frequencies of the differences, 1/s².
            square: f64,
        } => "the differences of sector `{sector}` do not oscillate: the mean square of their \
            angular frequencies is {square} 1/s²",
        /// The integration of a motion failed.
        Integration(error: IntegrationError<f64>) => "a motion could not be integrated to its end",
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

/// Checks that there is one number for each coordinate, and that none is negative.
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

/// Checks that there is one number for each coordinate.
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

/// Checks that a number is positive and finite.
pub(super) fn check_positive(what: &'static str, value: f64) -> Result<(), TruncationError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(TruncationError::Value { what, value })
}

/// Checks that amplitudes are positive and ascending.
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
