//! Errors in the computation of growth, and of periodic motions.

use crate::errors::errors;
use crate::integrate::IntegrationError;

errors! {
    /// Reason why the growth of differences, or a periodic motion, could not be computed.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum GrowthError {
        /// The frequency that relates differences and their rates is not positive.
        Frequency(frequency: f64) => "the frequency that relates differences to their rates is \
            {frequency} Hz: it must be positive",
        /// There are no horizons, or they are not positive and ascending.
        Horizons => "the horizons of growth must be positive times in ascending order",
        /// The difference at the start is zero, or has a wrong number of components.
        Difference => "the start must have as many components as the system, and a difference \
            that is not zero",
        /// The time (s) of a start differs from that of the first start.
        StartTime(time: f64) => "a start is at the time {time} s: all starts must be at the same \
            time",
        /// The frequency or the shape of a mode does not fit the system.
        Mode => "a mode must have a positive frequency, and a shape with one number for each angle",
        /// No periodic motion was found near the linear mode.
        NoOrbit => "found no periodic motion near the linear mode",
        /// The eigenvalues of the change of differences over a period were not found.
        Multipliers => "the search for the factors by which differences grow in a period did not \
            converge: the motion is too unstable",
        /// The integration of a motion failed.
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
