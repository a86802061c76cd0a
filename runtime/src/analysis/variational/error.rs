//! Errors in the computation of Lyapunov exponents.

use crate::errors::errors;
use crate::integrate::IntegrationError;

errors! {
    /// Reason why the Lyapunov exponents of a motion could not be computed.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum LyapunovError {
        /// The number of exponents requested is zero, or is larger than the number of independent
        /// deviations.
        Count {
            /// Number of exponents requested.
            count: usize,
            /// Number of independent deviations; if all deviations are followed, the dimension of
            /// the system.
            deviations: usize,
        } => "{count} exponents were requested, but there are {deviations} independent \
            deviations: request 1 to {deviations}",
        /// The interval is not positive and finite, or the number of intervals is zero.
        Interval {
            /// The interval given, s.
            interval: f64,
            /// The number of intervals given.
            intervals: u32,
        } => "cannot average over {intervals} intervals of {interval} s: use at least one \
            interval, with a positive length",
        /// Exponents of in-phase deviations or of differences between copies were requested, but
        /// the start is not in phase, or the links are not copies of each other.
        NotInPhase => "the copies do not start in phase (in equal states), or do not stay in \
            phase: start them in phase, or request the exponents of all deviations",
        /// A deviation became zero or overflowed between two orthonormalisations: the interval is
        /// too long.
        Degenerate {
            /// Time at the end of the interval, s.
            time: f64,
        } => "a deviation became zero or too large at t = {time} s: use a shorter interval",
        /// The integration of the motion failed.
        Integration(error: IntegrationError<f64>) => "{error}",
    }
}

impl std::error::Error for LyapunovError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Integration(error) => error.source(),
            _ => None,
        }
    }
}

impl From<IntegrationError<f64>> for LyapunovError {
    fn from(error: IntegrationError<f64>) -> Self {
        Self::Integration(error)
    }
}
