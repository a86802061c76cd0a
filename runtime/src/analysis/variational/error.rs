//! Why there are no exponents.

use crate::errors::errors;
use crate::integrate::IntegrationError;

errors! {
    /// Why there are no exponents.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum LyapunovError {
        /// None, or more than there are independent deviations.
        Count {
            /// Exponents asked for.
            count: usize,
            /// Number of independent deviations: for all of them the dimension of the system.
            deviations: usize,
        } => "{count} exponents asked for, of {deviations} independent deviations: ask for 1 to \
            {deviations}",
        /// The interval is not positive and finite, or no interval counts.
        Interval {
            /// The interval given.
            interval: f64,
            /// The number of intervals given.
            intervals: u32,
        } => "{intervals} intervals of {interval} s make no mean: ask for at least one, of a \
            positive time",
        /// Exponents within motions in phase or transverse to them, of a start that is in
        /// another state, or of links that are no copies.
        NotInPhase => "the copies are not in one state at the start, or do not move on alike: \
            start them in phase, or ask for the exponents of all deviations",
        /// A deviation vanished, or left the range of numbers, between two
        /// orthonormalisations: the interval is too long.
        Degenerate {
            /// End of the interval.
            time: f64,
        } => "a deviation has no direction any more at t = {time}: the interval is too long",
        /// The integration failed.
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
