//! Reasons why a normal form cannot be derived.

use crate::analysis::ModesError;
use crate::errors::errors;

errors! {
    /// Reason why a normal form cannot be derived.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    pub enum NormalFormError {
        /// The degree of the expansion is odd or out of range.
        Degree(degree: u32) => "expected an even degree from 4 to 12, found {degree}",
        /// There are more modes than a monomial can have exponents.
        TooManyModes {
            /// Number of modes: in-phase modes and differences.
            modes: usize,
            /// Largest number of modes.
            most: usize,
        } => "a normal form has at most {most} modes, and this motion has {modes}",
        /// The expansion of the energy would have too many monomials.
        TooManyMonomials {
            /// Upper bound of their number.
            monomials: f64,
            /// Largest number accepted.
            most: f64,
            /// The degree.
            degree: u32,
        } => "degree {degree} needs up to {monomials:.0} monomials, but at most {most:.0} are \
            accepted; help: use a smaller degree",
        /// The in-phase motion and the differences are coupled in linear order.
        Coupled => "the differences are linearly coupled to the in-phase motion: these links are \
            not copies of each other",
        /// The energy is infinite or NaN near the equilibrium.
        NotFinite => "the energy cannot be expanded about the equilibrium: it is infinite or NaN \
            there",
        /// The linear modes of the tree could not be computed.
        Modes(error: ModesError) => "{error}",
        /// A mode does not oscillate.
        NoFrequency(mode: usize) => "mode {mode} has the frequency zero: a normal form needs a \
            restoring torque on every mode",
    }
}

impl std::error::Error for NormalFormError {}

impl From<ModesError> for NormalFormError {
    fn from(error: ModesError) -> Self {
        Self::Modes(error)
    }
}
