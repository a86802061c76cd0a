//! The classical Runge–Kutta method.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]
// One index runs through several vectors at once.
#![allow(clippy::needless_range_loop)]

use alloc::vec;
use alloc::vec::Vec;

use super::grid::{Corrected, FixedStep, GridSteps};
use super::grid_position::Grid;
use crate::integrate::checkpoint::Memory;
use crate::integrate::error::InputError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::{Form, Piece};
use crate::integrate::request::all_finite;
use crate::integrate::right_hand_side::{RightHandSide, StepSpan};
use crate::integrate::steps::Failure;
use crate::scalar::{Real, Scalar};
use crate::system::{Ode, State};

/// The classical Runge–Kutta method of order 4, with steps of constant length.
///
/// It has no error estimate. Use it for comparisons, for many motions with given steps in the lanes
/// of vector registers ([`Ensemble::integrate_in_lanes`], with the same bits as a single motion),
/// or for frames in real time ([`Frames`]). A step takes four evaluations. Values within a step are
/// those of the cubic through its ends and their rates (order 3), without further evaluations.
/// Memory: 6 vectors of the state's length; steps allocate nothing. The last step is shorter if the
/// span is not a multiple of the step.
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
/// I*, 2nd edition, Springer 1993, section II.1, table 1.2.
///
/// [`Ensemble::integrate_in_lanes`]: crate::ensemble::Ensemble::integrate_in_lanes
/// [`Frames`]: crate::integrate::Frames
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
/// let start = State::new(0.0, vec![1.0]);
/// let solution = Rk4::new(0.01).run(&decay, &start, 1.0)?;
/// assert!((solution.state.values[0] - (-1.0_f64).exp()).abs() < 1e-10);
/// assert_eq!(solution.report.evaluations, 401);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rk4<T> {
    /// Length of the steps, positive for both directions of time.
    pub step: T,
    /// Number of steps after which a run ends with an error.
    pub step_limit: u64,
}

impl<T: Real> Rk4<T> {
    /// Creates the method with steps of length `step`, without a limit on their number.
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
        let step = Rk4Step::new(start.values.clone());
        Ok(GridSteps::new(step, self.grid().place()?))
    }
}

/// Workspace of a step of [`Rk4`], for one state or for several states in lanes.
#[derive(Clone, Debug)]
pub struct Rk4Step<W> {
    pub(in crate::integrate) start: Vec<W>,
    pub(in crate::integrate) end: Vec<W>,
    /// State at which rates are evaluated, followed by the rates.
    stage: Vec<W>,
    rates: Vec<W>,
    pub(in crate::integrate) start_rates: Vec<W>,
    pub(super) end_rates: Vec<W>,
    /// Length of the step; negative in a run backwards in time.
    pub(super) length: W,
}

impl<W: Scalar> Rk4Step<W> {
    /// Number of stages, not counting the evaluation at the end of the step.
    #[cfg(feature = "std")]
    pub(super) const STAGES: usize = 4;

    /// Allocates the workspace for steps from `start`.
    pub(in crate::integrate) fn new(start: Vec<W>) -> Self {
        let zeros = || vec![W::from_f64(0.0); start.len()];
        Self {
            end: zeros(),
            stage: zeros(),
            rates: zeros(),
            start_rates: zeros(),
            end_rates: zeros(),
            length: W::from_f64(0.0),
            start,
        }
    }

    /// Evaluates the rates at the start of the step: stage 1.
    #[inline(always)]
    pub(in crate::integrate) fn evaluate_start<S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        time: W,
    ) -> Result<(), S::Failure> {
        let n = system.dimension();
        system.evaluate(1, time, &self.start[..n], &mut self.start_rates[..n])
    }

    /// Computes stages 2 to 4 and the state at the end of the step, after stage 1 has been
    /// evaluated.
    ///
    /// It never uses fused multiply–add, so that a state in a lane has the same bits as a single
    /// state.
    #[inline(always)]
    pub(in crate::integrate) fn make_end<S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        span: StepSpan<W>,
    ) -> Result<(), S::Failure> {
        self.length = span.step;
        let n = system.dimension();
        let (start, stage) = (&self.start[..n], &mut self.stage[..n]);
        let (rates, first) = (&mut self.rates[..n], &self.start_rates[..n]);
        // `end` holds the sum of the rates first.
        let end = &mut self.end[..n];
        let half = W::from_f64(0.5) * span.step;
        let two = W::from_f64(2.0);
        let (middle, end_time) = (span.time + half, span.time + span.step);
        for i in 0..n {
            stage[i] = start[i] + half * first[i];
        }
        system.evaluate(2, middle, stage, rates)?;
        for i in 0..n {
            end[i] = first[i] + two * rates[i];
            stage[i] = start[i] + half * rates[i];
        }
        system.evaluate(3, middle, stage, rates)?;
        for i in 0..n {
            end[i] = end[i] + two * rates[i];
            stage[i] = start[i] + span.step * rates[i];
        }
        system.evaluate(4, end_time, stage, rates)?;
        let sixth = span.step / W::from_f64(6.0);
        for i in 0..n {
            end[i] = start[i] + sixth * (end[i] + rates[i]);
        }
        Ok(())
    }

    /// Evaluates the rates at the end of the step: stage 5, which is stage 1 of the next step.
    #[inline(always)]
    pub(super) fn evaluate_end<S: RightHandSide<W>>(
        &mut self,
        system: &mut S,
        time: W,
    ) -> Result<(), S::Failure> {
        let n = system.dimension();
        system.evaluate(5, time, &self.end[..n], &mut self.end_rates[..n])
    }
}

impl<T: Real, O: Ode<T> + ?Sized> FixedStep<T, O> for Rk4Step<T> {
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        self.evaluate_start(system, time)
    }

    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.make_end(system, StepSpan { time, step })?;
        let end_time = time + step;
        if !all_finite(&self.end) {
            return Err(NonFinite::new(end_time, &self.end).into());
        }
        Ok(self.evaluate_end(system, end_time)?)
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: Form::Hermite,
            start: &self.start,
            end: &self.end,
            terms: [&self.start_rates, &self.end_rates],
            length: self.length,
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
