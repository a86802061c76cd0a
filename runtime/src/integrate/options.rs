//! Options of a run: tolerances and limits.

use alloc::vec::Vec;

use super::error::InputError;
use crate::scalar::Real;

/// Tolerance of the error of one step: one number for all components, or one for each.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Tolerance<T> {
    /// One tolerance for all components.
    Uniform(T),
    /// A separate tolerance for each component of the state, in order.
    PerComponent(Vec<T>),
}

impl<T: Copy> Tolerance<T> {
    pub(crate) fn expand(&self, dimension: usize) -> Vec<T> {
        match self {
            Self::Uniform(value) => alloc::vec![*value; dimension],
            Self::PerComponent(values) => values.clone(),
        }
    }

    fn at(&self, component: usize) -> Option<T> {
        match self {
            Self::Uniform(value) => Some(*value),
            Self::PerComponent(values) => values.get(component).copied(),
        }
    }

    pub(crate) fn values(&self) -> &[T] {
        match self {
            Self::Uniform(value) => core::slice::from_ref(value),
            Self::PerComponent(values) => values,
        }
    }
}

/// Options of an adaptive integration.
///
/// The local error of component i is held below `absolute_i + relative_i |y_i|`, in the mean square
/// over the components. Relative tolerances below some ten [`Real::EPSILON`] require digits that
/// the type does not have: steps get smaller without improving the result. If the tolerance of a
/// component is below a quarter of [`Real::EPSILON`] times its starting value, the run is refused,
/// because the error estimate would consist of rounding. For [`Taylor`](super::Taylor) this limit
/// is a thousand times smaller.
///
/// # Examples
///
/// ```
/// use branched_pendulum::integrate::Options;
///
/// let options = Options { max_step: Some(0.1), ..Options::with_tolerance(1e-10) };
/// assert_eq!(options.step_limit, 1_000_000);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options<T> {
    /// Relative tolerance; may be zero if the absolute tolerance is positive.
    pub relative: Tolerance<T>,
    /// Absolute tolerance, in the units of the state; may be zero if the relative tolerance is
    /// positive.
    pub absolute: Tolerance<T>,
    /// Length of the first step to try. By default it is estimated, with one evaluation.
    pub initial_step: Option<T>,
    /// Longest step; by default the whole span. The last step may be 1 % longer, so that no tiny
    /// step remains.
    pub max_step: Option<T>,
    /// Shortest step, zero by default. A run that needs a shorter step ends with an error; only the
    /// last step may be shorter. Steps shorter than the rounding of the time are always an error.
    pub min_step: T,
    /// Number of steps, accepted and rejected, after which a run ends with an error.
    pub step_limit: u64,
    /// Weight of the error of the step before in the choice of the next step (PI control): 0 by
    /// default, up to 0.04 if steps are rejected often.
    pub beta: T,
    /// If true, the sums y + Δy keep their rounding errors (compensated summation, Kahan, Babuška).
    /// Rounding then adds nothing to the error of a long run; the cost is a few additions per step.
    pub compensated: bool,
}

impl<T: Real> Options<T> {
    /// Creates options with the relative tolerance `tolerance` and a thousandth of it as absolute
    /// tolerance for every component; all other options have their defaults.
    ///
    /// The tolerance of an angle is then relative down to a thousandth of a radian, because small
    /// disturbances that grow must be accurate while they are small. For the paper's pendulum near
    /// its threshold this makes the error after 10 s several times smaller than equal tolerances
    /// do, for a few per cent more work.
    pub fn with_tolerance(tolerance: T) -> Self {
        Self {
            relative: Tolerance::Uniform(tolerance),
            absolute: Tolerance::Uniform(tolerance * T::from_f64(1e-3)),
            initial_step: None,
            max_step: None,
            min_step: T::ZERO,
            step_limit: 1_000_000,
            beta: T::ZERO,
            compensated: false,
        }
    }

    /// Checks the options for a state of `dimension` components.
    ///
    /// # Errors
    ///
    /// The first [`InputError`] found: a tolerance, step or beta that is negative or not finite,
    /// both tolerances of a component zero, a wrong number of tolerances, a shortest step above the
    /// longest step.
    pub fn validate(&self, dimension: usize) -> Result<(), InputError<T>> {
        for (name, tolerance) in [("relative", &self.relative), ("absolute", &self.absolute)] {
            if let Tolerance::PerComponent(values) = tolerance
                && values.len() != dimension
            {
                return Err(InputError::ToleranceCount {
                    name,
                    expected: dimension,
                    found: values.len(),
                });
            }
            for (component, &value) in tolerance.values().iter().enumerate() {
                if !(value.is_finite() && value >= T::ZERO) {
                    return Err(InputError::Tolerance {
                        name,
                        component,
                        value,
                    });
                }
            }
        }
        let (relative, absolute) = (
            self.relative.expand(dimension),
            self.absolute.expand(dimension),
        );
        if let Some(component) = relative
            .iter()
            .zip(&absolute)
            .position(|(&r, &a)| r == T::ZERO && a == T::ZERO)
        {
            return Err(InputError::NoTolerance { component });
        }
        for (name, step) in [("initial", self.initial_step), ("longest", self.max_step)] {
            if let Some(value) = step
                && !(value.is_finite() && value > T::ZERO)
            {
                return Err(InputError::Step { name, value });
            }
        }
        if !(self.min_step.is_finite() && self.min_step >= T::ZERO) {
            return Err(InputError::Step {
                name: "shortest",
                value: self.min_step,
            });
        }
        if let Some(longest) = self.max_step
            && self.min_step > longest
        {
            return Err(InputError::StepRange {
                shortest: self.min_step,
                longest,
            });
        }
        // At 1/8 / 0.2 and above, the exponent of the controller changes its sign.
        if !(self.beta >= T::ZERO && self.beta <= T::from_f64(0.2)) {
            return Err(InputError::Beta { value: self.beta });
        }
        Ok(())
    }

    /// Checks that the tolerances do not require more digits than a motion from `start` has.
    /// `smallest` is the smallest relative tolerance that the method can use.
    pub(crate) fn check_digits(&self, start: &[T], smallest: T) -> Result<(), InputError<T>> {
        for (component, value) in start.iter().enumerate() {
            let [Some(relative), Some(absolute)] =
                [&self.relative, &self.absolute].map(|tolerance| tolerance.at(component))
            else {
                continue;
            };
            // Negative tolerances are refused elsewhere.
            if relative < T::ZERO || absolute < T::ZERO {
                continue;
            }
            // A component that starts from zero has an unknown size; 1 is assumed.
            let size = match value.abs() {
                size if size > T::ZERO => size,
                _ if relative > T::ZERO => T::ONE,
                _ => continue,
            };
            if absolute + relative * size < smallest * size {
                return Err(InputError::ToleranceBelowRounding {
                    component,
                    relative,
                    absolute,
                    smallest,
                });
            }
        }
        Ok(())
    }
}
