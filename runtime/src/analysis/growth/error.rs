//! Why there is no growth.

use core::fmt;

use crate::integrate::IntegrationError;

/// Reason for which a growth was not found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GrowthError {
    /// The frequency by which differences are looked at is not positive.
    Frequency(f64),
    /// There are no horizons, or they are not positive and ascending.
    Horizons,
    /// The start holds no difference, or its components are not those of the system.
    Difference,
    /// A start at another time than the first one's.
    StartTime(f64),
    /// The frequency or shape of a mode fits no release from rest.
    Mode,
    /// No periodic motion was found beside the mode.
    NoOrbit,
    /// The integration failed.
    Integration(Box<IntegrationError<f64>>),
}

impl fmt::Display for GrowthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Frequency(frequency) => write!(
                f,
                "differences are looked at by a positive frequency, not one of {frequency} Hz"
            ),
            Self::Horizons => f.write_str("the horizons of growth are positive times, ascending"),
            Self::Difference => f.write_str(
                "the start of a growth has a difference that is not zero, among as many components \
                 as the system has",
            ),
            Self::StartTime(time) => write!(
                f,
                "a start at {time} s is at another time than the first one"
            ),
            Self::Mode => f.write_str(
                "a mode has a positive frequency, and a shape of as many parts as there are angles",
            ),
            Self::NoOrbit => f.write_str("no periodic motion was found beside the linear mode"),
            Self::Integration(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for GrowthError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            _ => None,
        }
    }
}

impl From<IntegrationError<f64>> for GrowthError {
    fn from(error: IntegrationError<f64>) -> Self {
        Self::Integration(Box::new(error))
    }
}
