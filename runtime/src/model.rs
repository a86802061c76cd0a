//! Types that emitted functions return.

use alloc::format;
use alloc::string::String;
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
        write!(f, "{what} is {}, must be {requirement}", shown(*value))
    }
}

impl core::error::Error for ParameterError {}

/// A name that no parameter of a model has.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownParameter {
    /// The name.
    pub name: String,
    /// The names of the parameters, in their order.
    pub known: &'static [&'static str],
}

impl UnknownParameter {
    /// No parameter of these has the name.
    pub fn new(name: &str, known: &'static [&'static str]) -> Self {
        Self {
            name: name.into(),
            known,
        }
    }
}

impl fmt::Display for UnknownParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, known } = self;
        write!(
            f,
            "no parameter `{name}`: there are `{}`",
            known.join("`, `")
        )
    }
}

impl core::error::Error for UnknownParameter {}

/// Returns a value as messages show it: with an exponent where it is far from 1.
pub fn shown(value: f64) -> String {
    match value == 0.0 || (1e-5..1e16).contains(&value.abs()) || !value.is_finite() {
        true => format!("{value}"),
        false => format!("{value:e}"),
    }
}
