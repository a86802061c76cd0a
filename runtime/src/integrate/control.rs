//! Step-size control of adaptive methods: a proportional-integral controller, and Hairer's estimate
//! of the first step. Errors are scaled: 1 is the largest error that the tolerances allow.

use super::checkpoint::Memory;
use super::options::Options;
use crate::scalar::Real;

/// Constants of a method's step-size control.
#[derive(Clone, Copy, Debug)]
pub struct ControlConstants {
    /// Order of the method: the exponent with which the scaled error grows with the step length.
    pub(crate) order: u32,
    /// Safety factor that multiplies the step predicted for an error of exactly 1.
    pub(crate) safety: f64,
    /// Smallest ratio of a step to the step before.
    pub(crate) smallest_factor: f64,
    /// Largest ratio of a step to the step before.
    pub(crate) largest_factor: f64,
    /// Factor by which `beta`, the proportional gain, reduces the integral gain.
    pub(crate) beta_share: f64,
}

/// PI step-size control of K. Gustafsson, as in Hairer, Nørsett, Wanner,
/// *Solving ODEs I*, section II.4, and Hairer, Wanner, *Solving ODEs II*,
/// section IV.2, eq. (2.43a).
#[derive(Clone, Debug)]
pub(crate) struct StepControl<T> {
    constants: ControlConstants,
    beta: T,
    longest: Option<T>,
    previous_error: T,
    after_rejection: bool,
}

impl<T: Real> StepControl<T> {
    /// Creates a controller without memory of earlier steps. If [`Options::beta`] is zero, it is
    /// the elementary (integral) controller.
    pub(crate) fn new(constants: ControlConstants, options: &Options<T>) -> Self {
        Self {
            constants,
            beta: options.beta,
            longest: options.max_step,
            previous_error: T::from_f64(SMALLEST_REMEMBERED_ERROR),
            after_rejection: false,
        }
    }

    /// Forgets earlier steps.
    pub(crate) fn forget(&mut self) {
        self.previous_error = T::from_f64(SMALLEST_REMEMBERED_ERROR);
        self.after_rejection = false;
    }

    /// Saves or restores the controller's memory of earlier steps.
    pub(crate) fn remember(&mut self, memory: &mut Memory<T>) {
        memory.number(&mut self.previous_error);
        memory.flag(&mut self.after_rejection);
    }

    /// Accepts or rejects a step from its scaled error norm. `made` and `planned` are the step's
    /// actual and planned lengths; they differ only if the step is the `last` of the run.
    #[inline(always)]
    pub(crate) fn judge(&mut self, error: T, made: T, (planned, last): (T, bool)) -> Verdict<T> {
        // An error that is NaN must not pass either.
        if !matches!(error.partial_cmp(&T::ONE), Some(order) if order.is_le()) {
            return Verdict::Rejected(made * self.reject(error));
        }
        let proposed = made * self.accept(error);
        // The end of the run shortened this step, which is no reason to shorten the planned one.
        let next = if last {
            proposed.max(planned)
        } else {
            proposed
        };
        Verdict::Accepted(self.longest.map_or(next, |longest| next.min(longest)))
    }

    /// Returns the ratio of the next step's length to that of an accepted step with the scaled
    /// error `error` ≤ 1.
    fn accept(&mut self, error: T) -> T {
        let largest = if self.after_rejection {
            // The step before was rejected, so the step must not grow yet.
            T::ONE
        } else {
            T::from_f64(self.constants.largest_factor)
        };
        let mut growth = self.error_power(error);
        if self.beta > T::ZERO {
            growth = growth / self.previous_error.powf(self.beta);
        }
        self.previous_error = error.max(T::from_f64(SMALLEST_REMEMBERED_ERROR));
        self.after_rejection = false;
        // A growth of zero gives infinity, which the upper bound replaces.
        (T::from_f64(self.constants.safety) / growth)
            .min(largest)
            .max(T::from_f64(self.constants.smallest_factor))
    }

    /// Returns the ratio of the next trial step's length to that of a rejected step. An infinite or
    /// NaN error gives the smallest ratio.
    fn reject(&mut self, error: T) -> T {
        self.after_rejection = true;
        let smallest = T::from_f64(self.constants.smallest_factor);
        if !error.is_finite() {
            return smallest;
        }
        (T::from_f64(self.constants.safety) / self.error_power(error)).max(smallest)
    }

    /// Computes the power of a scaled error in the controller: error^(1/order − beta_share · beta).
    fn error_power(&self, error: T) -> T {
        if self.beta > T::ZERO {
            let share = T::from_f64(self.constants.beta_share);
            let exponent = T::ONE / T::from_f64(f64::from(self.constants.order));
            error.powf(exponent - share * self.beta)
        } else {
            root(error, self.constants.order)
        }
    }
}

/// Result of the step-size control: a step is accepted or rejected, with the length of the step to
/// try next.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Verdict<T> {
    Accepted(T),
    Rejected(T),
}

/// Smallest scaled error that the controller remembers: a step that was far too short says little
/// about the next.
const SMALLEST_REMEMBERED_ERROR: f64 = 1e-4;

/// Computes value^(1/order), by square roots if they suffice: they are cheaper than `pow` and
/// correctly rounded, so that a run does not depend on a library's `pow`.
fn root<T: Real>(value: T, order: u32) -> T {
    if order.is_power_of_two() {
        (0..order.trailing_zeros()).fold(value, |value, _| value.sqrt())
    } else {
        value.powf(T::ONE / T::from_f64(f64::from(order)))
    }
}

/// Input of the first-step estimate. Norms are Euclidean norms of components divided by their
/// tolerances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstStep<T> {
    /// Norm of the state.
    pub(crate) state: T,
    /// Norm of the rates.
    pub(crate) rates: T,
    /// The longest step allowed.
    pub(crate) longest: T,
}

impl<T: Real> FirstStep<T> {
    /// Returns the length of an explicit Euler step whose increment is small compared with the
    /// state, as a first estimate of the step length. Hairer, Nørsett, Wanner, *Solving ODEs I*,
    /// section II.4.
    pub(crate) fn euler(&self) -> T {
        let negligible = T::from_f64(1e-5);
        let step = if self.rates <= negligible || self.state <= negligible {
            T::from_f64(1e-6)
        } else {
            T::from_f64(0.01) * self.state / self.rates
        };
        step.min(self.longest)
    }

    /// Returns the first step of a method of order `order`, from the norm of the change of the
    /// rates over the Euler step.
    pub(crate) fn refined(&self, euler: T, change_of_rates: T, order: u32) -> T {
        let curvature = (change_of_rates / euler).max(self.rates);
        let step = if curvature <= T::from_f64(1e-15) {
            T::from_f64(1e-6).max(euler * T::from_f64(1e-3))
        } else {
            root(T::from_f64(0.01) / curvature, order)
        };
        (T::from_f64(100.0) * euler).min(step).min(self.longest)
    }
}

#[cfg(test)]
mod tests {
    use super::{ControlConstants, Options, StepControl, root};

    const CONSTANTS: ControlConstants = ControlConstants {
        order: 8,
        safety: 0.9,
        smallest_factor: 1.0 / 3.0,
        largest_factor: 6.0,
        beta_share: 0.2,
    };

    fn control(beta: f64) -> StepControl<f64> {
        let options = Options::with_tolerance(1e-9);
        StepControl::new(CONSTANTS, &Options { beta, ..options })
    }

    #[test]
    fn roots_by_square_roots_equal_powers() {
        for value in [1e-30_f64, 1e-4, 0.5, 1.0, 300.0] {
            for order in [1_u32, 2, 4, 5, 8] {
                let expected = value.powf(1.0 / f64::from(order));
                assert!((root(value, order) / expected - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn an_error_at_the_limit_shrinks_by_the_safety_factor() {
        let mut control = control(0.0);
        assert_eq!(control.accept(1.0), 0.9);
        // 2^8 times too large: half of it, and the safety factor.
        assert_eq!(control.reject(256.0), 0.45);
    }

    #[test]
    fn factors_stay_between_their_limits() {
        let mut control = control(0.0);
        assert_eq!(control.accept(0.0), 6.0);
        assert_eq!(control.reject(1e30), 1.0 / 3.0);
        assert_eq!(control.reject(f64::NAN), 1.0 / 3.0);
        assert_eq!(control.reject(f64::INFINITY), 1.0 / 3.0);
    }

    #[test]
    fn no_growth_directly_after_a_rejection() {
        let mut control = control(0.0);
        control.reject(2.0);
        assert_eq!(control.accept(1e-6), 1.0);
        assert!(control.accept(1e-6) > 1.0);
    }

    #[test]
    fn the_integral_part_damps_a_growing_error() {
        let mut damped = control(0.04);
        let mut plain = control(0.0);
        for control in [&mut damped, &mut plain] {
            control.accept(0.9);
        }
        // Falling from 0.9 to 0.01 in one step, the damped one trusts less.
        assert!(damped.accept(0.01) < plain.accept(0.01));
    }
}
