//! Types that emitted functions return.

use core::fmt;
use core::ops::Add;

/// Energy transfer W into one mode, in watts, by the part of the rest of the
/// tree that it comes from: {H_d, K − T} and {H_d, U − V}.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transfer<T> {
    /// What the kinetic energy does, W_K.
    pub kinetic: T,
    /// What the potential energy does, W_P.
    pub potential: T,
}

impl<T: Add<Output = T>> Transfer<T> {
    /// W = W_K + W_P.
    pub fn total(self) -> T {
        self.kinetic + self.potential
    }
}

/// A parameter that no pendulum can have.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ParameterError {
    /// The quantity, as in "mass of `child`".
    pub what: &'static str,
    /// Its value, in SI units.
    pub value: f64,
    /// What it has to be, as in "positive".
    pub requirement: &'static str,
}

impl ParameterError {
    /// Passes a finite value.
    ///
    /// # Errors
    /// The error that `what` is not finite.
    pub fn require_finite(what: &'static str, value: f64) -> Result<(), Self> {
        Self::require(what, value, "finite", true)
    }

    /// Passes a finite value that is not negative.
    ///
    /// # Errors
    /// The error that `what` is negative or not finite.
    pub fn require_non_negative(what: &'static str, value: f64) -> Result<(), Self> {
        Self::require(what, value, "zero or positive", value >= 0.0)
    }

    /// Passes a finite positive value.
    ///
    /// # Errors
    /// The error that `what` is not positive or not finite.
    pub fn require_positive(what: &'static str, value: f64) -> Result<(), Self> {
        Self::require(what, value, "positive", value > 0.0)
    }

    fn require(
        what: &'static str,
        value: f64,
        requirement: &'static str,
        met: bool,
    ) -> Result<(), Self> {
        if met && value.is_finite() {
            return Ok(());
        }
        Err(Self {
            what,
            value,
            requirement,
        })
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            what,
            value,
            requirement,
        } = self;
        write!(f, "{what} is {value}, must be {requirement}")
    }
}

impl core::error::Error for ParameterError {}
