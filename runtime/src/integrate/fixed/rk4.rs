//! The classical Runge–Kutta method.

use super::explicit::{ExplicitFormula, ExplicitStep};
use super::grid::{Grid, GridSteps};
use crate::integrate::error::InputError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::Form;
use crate::integrate::request::all_finite;
use crate::integrate::steps::Failure;
use crate::scalar::Real;
use crate::system::{Ode, State};

/// The classical Runge–Kutta method of order 4, with steps of one length.
///
/// No error estimate: it is here for comparison, and for loops whose steps are
/// given. Four evaluations a step; values inside a step are those of the cubic
/// through its ends with their rates (order 3) and cost nothing. Memory: 6
/// vectors of the state's length; steps allocate nothing. The last step is
/// shorter where the span is no multiple of the step.
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
/// I*, 2nd edition, Springer 1993, section II.1, table 1.2.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
/// let start = State::new(0.0, vec![1.0]);
/// let solution = Rk4::new(0.01).integrate(&decay, &start, 1.0, |_| ControlFlow::Continue(()))?;
/// assert!((solution.state.values[0] - (-1.0_f64).exp()).abs() < 1e-10);
/// assert_eq!(solution.report.evaluations, 401);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rk4<T> {
    /// Length of the steps, positive whatever the direction.
    pub step: T,
    /// Number of steps after which a run ends with an error.
    pub step_limit: u64,
}

impl<T: Real> Rk4<T> {
    /// The method with steps of length `step`, without a limit on their
    /// number.
    pub fn new(step: T) -> Self {
        Self {
            step,
            step_limit: u64::MAX,
        }
    }

    pub(super) fn grid(&self) -> Grid<T> {
        Grid {
            step: self.step,
            halvings: 0,
            step_limit: self.step_limit,
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> Integrator<T, O> for Rk4<T> {
    type Steps = GridSteps<ExplicitStep<Rk4Formula, T>, T>;

    fn steps(&self, _ode: &O, start: &State<T>) -> Result<Self::Steps, InputError<T>> {
        self.grid().steps(ExplicitStep::new(&start.values))
    }
}

/// The formula of [`Rk4`].
#[derive(Clone, Copy, Debug)]
#[allow(unreachable_pub)]
pub struct Rk4Formula;

impl<T: Real, O: Ode<T> + ?Sized> ExplicitFormula<T, O> for Rk4Formula {
    const FORM: Form = Form::Hermite;

    fn make(
        own: &mut ExplicitStep<Self, T>,
        system: &mut Evaluator<'_, T, O>,
        time: T,
    ) -> Result<(), Failure<T>> {
        let step = own.step;
        let half = T::from_f64(0.5) * step;
        let two = T::from_f64(2.0);
        let (middle, end_time) = (time + half, time + step);
        // The end holds the sum of the rates until it is known.
        own.end.copy_from_slice(&own.start_rates);
        own.rates.copy_from_slice(&own.start_rates);
        for (at, length, weight) in [
            (middle, half, two),
            (middle, half, two),
            (end_time, step, T::ONE),
        ] {
            for (i, value) in own.stage.iter_mut().enumerate() {
                *value = own.start[i] + length * own.rates[i];
            }
            system.evaluate(at, &own.stage, &mut own.rates)?;
            for (sum, &rate) in own.end.iter_mut().zip(&own.rates) {
                *sum += weight * rate;
            }
        }
        let sixth = step / T::from_f64(6.0);
        for (end, &start) in own.end.iter_mut().zip(&own.start) {
            *end = start + sixth * *end;
        }
        if !all_finite(&own.end) {
            return Err(NonFinite::new(end_time, &own.end).into());
        }
        Ok(system.evaluate(end_time, &own.end, &mut own.end_rates)?)
    }
}
