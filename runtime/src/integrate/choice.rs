//! Choice of the method that is usually the fastest.

use core::fmt;
use core::str::FromStr;

use super::method::{Method, UnknownMethod};
use crate::system::TaylorOde;

/// Largest number of components of a state for which Taylor series are the fastest at any tolerance:
/// ten links.
const SMALL_STATE: usize = 20;

/// Largest number of components for which they are the fastest at 1e-6 and below: a hundred links.
/// Larger states take them below 1e-9 only.
const LARGE_STATE: usize = 200;

impl Method {
    /// Returns the method that usually takes the least time for one motion of this system at a
    /// relative tolerance.
    ///
    /// The choice is [`Taylor`](super::Taylor) if the system has Taylor series and is small enough
    /// for the tolerance: up to 20 components at any tolerance, up to 200 at 1e-6 and below, any
    /// number below 1e-9. Otherwise it is that of [`explicit_pair`](Self::explicit_pair). The
    /// limits come from the tables of `docs/integrators.md`; `branched-pendulum advise` measures the
    /// candidates on one machine. The choice does not consider stiff systems, which need
    /// [`Gauss`](super::Gauss).
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::integrate::Method;
    /// use branched_pendulum::system::{OdeFn, RatesOnly};
    ///
    /// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
    /// assert_eq!(Method::for_model(&RatesOnly(&decay), 1e-9), Method::Verner98);
    /// assert_eq!(Method::for_model(&RatesOnly(&decay), 1e-3), Method::Dop853);
    /// ```
    pub fn for_model<T>(system: &(impl TaylorOde<T> + ?Sized), tolerance: f64) -> Self {
        let size = system.dimension();
        let series =
            size <= SMALL_STATE || size <= LARGE_STATE && tolerance <= 1e-6 || tolerance < 1e-9;
        match system.has_series() && series {
            true => Self::Taylor,
            false => Self::explicit_pair(tolerance),
        }
    }

    /// Returns the method that usually takes the least time for many motions that are integrated in
    /// the lanes of vector registers: [`Taylor`](super::Taylor) at 1e-10 and below if the system has
    /// Taylor series and at most 20 components, otherwise that of
    /// [`explicit_pair`](Self::explicit_pair). At looser tolerances the pairs are faster at equal
    /// errors (`docs/integrators.md`, *Many trajectories*).
    pub fn for_lanes<T>(system: &(impl TaylorOde<T> + ?Sized), tolerance: f64) -> Self {
        let series = system.has_series() && system.dimension() <= SMALL_STATE;
        match series && tolerance <= 1e-10 {
            true => Self::Taylor,
            false => Self::explicit_pair(tolerance),
        }
    }

    /// Returns the explicit pair that usually takes the least time at a relative tolerance:
    /// [`Dop853`](super::Dop853) at 1e-4 and above, and [`Verner98`](super::Verner98) below.
    pub fn explicit_pair(tolerance: f64) -> Self {
        match tolerance >= 1e-4 {
            true => Self::Dop853,
            false => Self::Verner98,
        }
    }
}

/// Choice of an integration method by a user: a method, or `auto`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MethodChoice {
    /// The method that is usually the fastest ([`Method::for_model`], [`Method::for_lanes`]).
    Auto,
    /// This method.
    Given(Method),
}

impl MethodChoice {
    /// Name that leaves the choice to the program.
    const AUTO: &'static str = "auto";

    /// Returns the chosen method; `automatic` is called for [`Auto`](Self::Auto).
    pub fn method(self, automatic: impl FnOnce() -> Method) -> Method {
        match self {
            Self::Auto => automatic(),
            Self::Given(method) => method,
        }
    }
}

impl FromStr for MethodChoice {
    type Err = UnknownChoice;

    fn from_str(name: &str) -> Result<Self, UnknownChoice> {
        match name.eq_ignore_ascii_case(Self::AUTO) {
            true => Ok(Self::Auto),
            false => name.parse().map(Self::Given).map_err(UnknownChoice),
        }
    }
}

/// Error: a name is neither that of a method nor `auto`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownChoice(pub UnknownMethod);

impl fmt::Display for UnknownChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; `{}` chooses one", self.0, MethodChoice::AUTO)
    }
}

impl core::error::Error for UnknownChoice {}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::*;

    #[test]
    fn auto_is_a_choice_and_errors_name_it() {
        assert_eq!("Auto".parse(), Ok(MethodChoice::Auto));
        assert_eq!("rk4".parse(), Ok(MethodChoice::Given(Method::Rk4)));
        let error = "euler".parse::<MethodChoice>().unwrap_err().to_string();
        assert!(error.starts_with("there is no method `euler`"), "{error}");
        assert!(error.ends_with("; `auto` chooses one"), "{error}");
    }
}
