//! Why there is no growth.

use crate::errors::errors;
use crate::integrate::IntegrationError;

errors! {
    /// Reason for which a growth was not found.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum GrowthError {
        /// The frequency by which differences are looked at is not positive.
        Frequency(frequency: f64) => "differences are looked at by a positive frequency, not one \
            of {frequency} Hz",
        /// There are no horizons, or they are not positive and ascending.
        Horizons => "the horizons of growth are positive times, ascending",
        /// The start holds no difference, or its components are not those of the system.
        Difference => "the start of a growth has a difference that is not zero, among as many \
            components as the system has",
        /// A start at another time than the first one's.
        StartTime(time: f64) => "a start at {time} s is at another time than the first one",
        /// The frequency or shape of a mode fits no release from rest.
        Mode => "a mode has a positive frequency, and a shape of as many parts as there are \
            angles",
        /// No periodic motion was found beside the mode.
        NoOrbit => "no periodic motion was found beside the linear mode",
        /// The integration failed.
        Integration(error: Box<IntegrationError<f64>>) => "{error}",
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
