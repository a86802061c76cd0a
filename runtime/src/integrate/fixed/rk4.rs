//! The classical Runge–Kutta method.

// A sealed trait names the types.
#![allow(unreachable_pub)]

use alloc::vec;
use alloc::vec::Vec;

use super::grid::{FixedStep, Grid, GridSteps};
use super::projected::Corrected;
use crate::integrate::checkpoint::Memory;
use crate::integrate::error::InputError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::{Form, Piece};
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
    type Steps = GridSteps<Rk4Step<T>, T>;

    fn steps(&self, _ode: &O, start: &State<T>) -> Result<Self::Steps, InputError<T>> {
        self.grid().steps(Rk4Step::new(&start.values))
    }
}

/// The vectors that a step of [`Rk4`] works on.
#[derive(Clone, Debug)]
pub struct Rk4Step<T> {
    start: Vec<T>,
    end: Vec<T>,
    /// State at which rates are evaluated, and these.
    stage: Vec<T>,
    rates: Vec<T>,
    start_rates: Vec<T>,
    end_rates: Vec<T>,
    /// Length of the step, with its sign.
    step: T,
}

impl<T: Real> Rk4Step<T> {
    pub(super) fn new(start: &[T]) -> Self {
        let zeros = || vec![T::ZERO; start.len()];
        Self {
            start: start.to_vec(),
            end: zeros(),
            stage: zeros(),
            rates: zeros(),
            start_rates: zeros(),
            end_rates: zeros(),
            step: T::ZERO,
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> FixedStep<T, O> for Rk4Step<T> {
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        system.evaluate(time, &self.start, &mut self.start_rates)
    }

    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.step = step;
        let half = T::from_f64(0.5) * step;
        let two = T::from_f64(2.0);
        let (middle, end_time) = (time + half, time + step);
        // The end holds the sum of the rates until it is knself.
        self.end.copy_from_slice(&self.start_rates);
        self.rates.copy_from_slice(&self.start_rates);
        for (at, length, weight) in [
            (middle, half, two),
            (middle, half, two),
            (end_time, step, T::ONE),
        ] {
            for (i, value) in self.stage.iter_mut().enumerate() {
                *value = self.start[i] + length * self.rates[i];
            }
            system.evaluate(at, &self.stage, &mut self.rates)?;
            for (sum, &rate) in self.end.iter_mut().zip(&self.rates) {
                *sum += weight * rate;
            }
        }
        let sixth = step / T::from_f64(6.0);
        for (end, &start) in self.end.iter_mut().zip(&self.start) {
            *end = start + sixth * *end;
        }
        if !all_finite(&self.end) {
            return Err(NonFinite::new(end_time, &self.end).into());
        }
        Ok(system.evaluate(end_time, &self.end, &mut self.end_rates)?)
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: Form::Hermite,
            start: &self.start,
            end: &self.end,
            terms: [&self.start_rates, &self.end_rates],
            length: self.step,
        }
    }

    fn advance(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        core::mem::swap(&mut self.start_rates, &mut self.end_rates);
    }

    fn set_start(&mut self, values: &[T]) {
        self.start.copy_from_slice(values);
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.numbers(&mut self.start_rates);
    }
}

impl<T: Real, O: Ode<T> + ?Sized> Corrected<T, O> for Rk4Step<T> {
    fn correct(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        correction: &[T],
    ) -> Result<(), Failure<T>> {
        for (end, &correction) in self.end.iter_mut().zip(correction) {
            *end += correction;
        }
        Ok(system.evaluate(time, &self.end, &mut self.end_rates)?)
    }
}
