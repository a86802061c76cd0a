//! Types that emitted functions return.

use alloc::format;
use alloc::string::String;
use core::fmt;
use core::ops::Add;

/// Energy transfer W into one mode (with energy H_d = T + V) from the rest of the tree, in watts.
/// It is split into {H_d, K − T} from the tree's kinetic energy K and {H_d, U − V} from its
/// potential energy U.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Transfer<T> {
    /// Part W_K from kinetic energy.
    pub kinetic: T,
    /// Part W_P from potential energy.
    pub potential: T,
}

impl<T: Add<Output = T>> Transfer<T> {
    /// Returns W = W_K + W_P.
    pub fn total(self) -> T {
        self.kinetic + self.potential
    }
}

/// Error: a parameter has a value that is not physical.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ParameterError {
    /// Name of the quantity, such as "mass of `child`".
    pub what: &'static str,
    /// Value of the quantity, in SI units.
    pub value: f64,
    /// Condition that the value violates, such as "finite and positive".
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

/// Error: a model has no parameter with this name.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownParameter {
    /// The unknown name.
    pub name: String,
    /// Names of all parameters of the model, in order.
    pub known: &'static [&'static str],
}

impl UnknownParameter {
    /// Creates the error that `name` is not the name of a parameter; `known` are the names of all
    /// parameters.
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

/// Formats a value for messages, with an exponent if it is far from 1.
pub fn shown(value: f64) -> String {
    match value == 0.0 || (1e-5..1e16).contains(&value.abs()) || !value.is_finite() {
        true => format!("{value}"),
        false => format!("{value:e}"),
    }
}
