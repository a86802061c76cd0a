//! Types that emitted functions return.

use core::fmt;
use core::ops::Add;

use crate::scalar::dispatch::Kernel;

/// Energy transfer W into one mode, in watts, by the part of the rest of the
/// tree that it comes from: {H_d, K − T} and {H_d, U − V}.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// A part of an emitted function that is too long to be one.
#[doc(hidden)]
pub trait Part<const NUMBER: usize, A> {
    /// The values that the part hands on.
    type Output;

    /// Computes it.
    fn part(&self, arguments: A) -> Self::Output;
}

/// A [`Part`] with what it gets.
pub(crate) struct PartOf<'a, const NUMBER: usize, M, A> {
    pub(crate) model: &'a M,
    pub(crate) arguments: A,
}

impl<const NUMBER: usize, A, M: Part<NUMBER, A>> Kernel for PartOf<'_, NUMBER, M, A> {
    type Output = M::Output;

    #[inline(always)]
    fn run(self) -> M::Output {
        self.model.part(self.arguments)
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
    /// The condition on it, as in "positive".
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
