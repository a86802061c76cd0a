//! Types that emitted functions return.

use core::fmt;
use core::ops::Add;

/// Energy transfer W into one mode, in watts, by the part of the rest of the
/// tree that it comes from: {H_d, K − T} and {H_d, U − V}.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Transfer<T> {
    /// Part of the kinetic energy, W_K.
    pub kinetic: T,
    /// Part of the potential energy, W_P.
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
    /// Value of the quantity, in SI units.
    pub value: f64,
    /// The condition on it, as in "finite and positive".
    pub requirement: &'static str,
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
