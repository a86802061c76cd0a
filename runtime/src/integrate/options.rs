//! Options of a run: tolerances and limits.

use alloc::vec::Vec;

use super::error::InputError;
use crate::scalar::Real;

/// Tolerance of the error of one step: one number for all components, or one
/// for each.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Tolerance<T> {
    /// One for all components.
    Uniform(T),
    /// One for each component of the state, in order.
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
/// The local error of component i is held below
/// `absolute_i + relative_i |y_i|`, in the mean square over the components.
/// Relative tolerances below some ten [`Real::EPSILON`] ask for digits that the
/// type does not hold: the steps get smaller and the result no better. Where the
/// tolerance of a component is below a quarter of [`Real::EPSILON`] of its starting value,
/// a run is refused: the estimate of the error would be its own rounding.
/// [`Taylor`](super::Taylor) goes down to a thousandth of it.
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
    /// Relative tolerance; zero is allowed where the absolute one is positive.
    pub relative: Tolerance<T>,
    /// Absolute tolerance, in the units of the state; zero is allowed where
    /// the relative one is positive.
    pub absolute: Tolerance<T>,
    /// Length of the first step that is tried; by default it is estimated, at
    /// the cost of one evaluation.
    pub initial_step: Option<T>,
    /// Longest step allowed; by default the whole span. The last step may be
    /// 1 % longer, so that no sliver is left over.
    pub max_step: Option<T>,
    /// Shortest step allowed; a run that needs a shorter one ends with an
    /// error. The last step may be shorter. By default zero; steps that are
    /// lost in the rounding of the time are an error in any case.
    pub min_step: T,
    /// Number of steps, accepted and rejected together, after which a run ends
    /// with an error.
    pub step_limit: u64,
    /// Weight of the error before the last in the choice of the next step (PI
    /// control): 0 by default, up to 0.04 where steps are rejected often.
    pub beta: T,
    /// True to carry the rounding errors of the sums y + Δy along (Kahan,
    /// Babuška): the error of a long run then grows with the method's
    /// error alone. Costs a few additions a step.
    pub compensated: bool,
}

impl<T: Real> Options<T> {
    /// Relative tolerance `tolerance` and absolute tolerance a thousandth of it
    /// for every component, all else by default.
    ///
    /// So an angle counts in its own measure down to a thousandth of a radian:
    /// what a small disturbance grows into is decided while it is small. For
    /// the paper's pendulum near its threshold this makes the error after 10 s
    /// several times smaller than equal tolerances do, for a few per cent more
    /// work.
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
    /// The first [`InputError`] found: a tolerance, step or beta that is
    /// negative or not finite, both tolerances of a component zero, the wrong
    /// number of tolerances, a shortest step above the longest.
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
        // From 1/8 / 0.2 on the exponent of the controller changes its sign.
        if !(self.beta >= T::ZERO && self.beta <= T::from_f64(0.2)) {
            return Err(InputError::Beta { value: self.beta });
        }
        Ok(())
    }

    /// Passes tolerances that ask for no more digits than a motion from `start` has,
    /// `smallest` being the least relative tolerance that a method can use.
    pub(crate) fn check_digits(&self, start: &[T], smallest: T) -> Result<(), InputError<T>> {
        for (component, value) in start.iter().enumerate() {
            let [Some(relative), Some(absolute)] =
                [&self.relative, &self.absolute].map(|tolerance| tolerance.at(component))
            else {
                continue;
            };
            // A tolerance below zero is refused as such.
            if relative < T::ZERO || absolute < T::ZERO {
                continue;
            }
            // What starts from zero gets a size that is not known: one, if that counts.
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
