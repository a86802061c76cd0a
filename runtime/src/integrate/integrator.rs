//! The trait that all integration methods implement.

use alloc::vec::Vec;
use core::convert::Infallible;
use core::ops::ControlFlow;

use super::checkpoint::Checkpoint;
use super::dense::DenseStep;
use super::error::{InputError, IntegrationError, RunError};
use super::events::{Event, Occurrence};
use super::report::{Solution, StopReason};
use super::run::Run;
use super::stepper::Stepper;
use super::steps::Steps;
use super::trajectory::Trajectory;
use crate::scalar::Real;
use crate::system::{Ode, State};

/// A method that can integrate the system `O`.
///
/// The system is a parameter of the trait and not of its functions, so that a method can require
/// more than rates: the Taylor series method integrates only systems that provide Taylor
/// coefficients.
///
/// Other crates cannot implement this trait.
///
/// # Examples
///
/// A function whose caller chooses the method:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// fn at_one<O: Ode<f64>>(method: &impl Integrator<f64, O>, ode: &O)
///     -> Result<f64, IntegrationError<f64>> {
///     let start = State::new(0.0, vec![1.0]);
///     let solution = method.run(ode, &start, 1.0)?;
///     Ok(solution.state.values[0])
/// }
///
/// let growth = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = y[0]);
/// let options = Options::with_tolerance(1e-12);
/// let e = core::f64::consts::E;
/// assert!((at_one(&Dop853::new(options.clone()), &growth)? - e).abs() < 1e-11);
/// assert!((at_one(&Verner98::new(options), &growth)? - e).abs() < 1e-11);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
pub trait Integrator<T: Real, O: Ode<T> + ?Sized> {
    /// Data of the method that lasts for a run.
    #[doc(hidden)]
    type Steps: Steps<T, O>;

    /// Creates the data for a run from `start`, which has been checked.
    ///
    /// # Errors
    ///
    /// [`InputError`] if the options do not suit the method or the equations.
    #[doc(hidden)]
    fn steps(&self, ode: &O, start: &State<T>) -> Result<Self::Steps, InputError<T>>;

    /// Starts a motion that the caller advances step by step or frame by frame, as a [`Stepper`].
    ///
    /// # Errors
    ///
    /// [`IntegrationError::Input`].
    fn start(&self, ode: O, start: &State<T>) -> Result<Stepper<Self, O, T>, IntegrationError<T>>
    where
        Self: Sized,
        O: Sized,
    {
        Stepper::new(self, ode, start)
    }

    /// Continues a motion from a checkpoint made by [`Stepper::checkpoint`]. Method and equations
    /// must be the same as before; only the lengths of their data are checked.
    ///
    /// # Errors
    ///
    /// [`IntegrationError::Input`].
    fn resume(
        &self,
        ode: O,
        checkpoint: &Checkpoint<T>,
    ) -> Result<Stepper<Self, O, T>, IntegrationError<T>>
    where
        Self: Sized,
        O: Sized,
    {
        Stepper::resumed(self, ode, checkpoint)
    }

    /// Integrates from `start` to the time `end`, which may be earlier, and returns the state
    /// there. This is [`integrate`](Self::integrate) without an observer.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate).
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
    /// let method = Dop853::new(Options::with_tolerance(1e-12));
    /// let end = method.run(&decay, &State::new(0.0, vec![1.0]), 2.0)?.state;
    /// assert!((end.values[0] - (-2.0_f64).exp()).abs() < 1e-12);
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    fn run(&self, ode: &O, start: &State<T>, end: T) -> Result<Solution<T>, IntegrationError<T>> {
        self.integrate(ode, start, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates from `start` to the time `end`, which may be earlier, and calls an observer after
    /// each step.
    ///
    /// `observer` is called with every accepted step and can end the run with
    /// [`ControlFlow::Break`]; the last state is then the end of that step. If `end` is the start
    /// time, the start is returned without an evaluation.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`]: an invalid argument, rates that are not finite, a step that becomes
    /// too small, too many steps. All but the first carry the last good state.
    fn integrate(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        mut observer: impl FnMut(&mut DenseStep<'_, T>) -> ControlFlow<()>,
    ) -> Result<Solution<T>, IntegrationError<T>> {
        let observer = |step: &mut DenseStep<'_, T>| Ok::<_, Infallible>(observer(step));
        Ok(self.try_integrate(ode, start, end, observer)?)
    }

    /// Integrates like [`integrate`](Self::integrate), with an observer that can return an error,
    /// which ends the run.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate), and [`RunError::Observer`] with the error of the observer
    /// and the state at the end of the step that it was called with.
    fn try_integrate<E>(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        mut observer: impl FnMut(&mut DenseStep<'_, T>) -> Result<ControlFlow<()>, E>,
    ) -> Result<Solution<T>, RunError<T, E>> {
        let mut run = Run::to_end(self, ode, start, end)?;
        let goal = run.goal(end);
        while let Some(mut step) = run.step_to(goal)? {
            match observer(&mut step) {
                Ok(ControlFlow::Continue(())) => {}
                Ok(ControlFlow::Break(())) => {
                    return Ok(run.solution(StopReason::StoppedByObserver));
                }
                Err(error) => return Err(run.stopped_at(run.time(), run.state(), error)),
            }
        }
        Ok(run.solution(StopReason::EndReached))
    }

    /// Integrates from `start` through the given times, in their order, and calls `visit` with each
    /// time and the state there.
    ///
    /// The states come from the dense output. The steps are those of
    /// [`integrate`](Self::integrate) to the last time and do not depend on the times between.
    /// A time equal to the start is visited with the start itself; repeated times are visited
    /// repeatedly. If `times` is empty, the start is returned.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate); times must be finite and all increase, or all decrease,
    /// from the start. After an error all times up to the last good state have been visited, unless
    /// the rates were not finite within the last step.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
    /// let times = [0.0, 0.5, 1.0, 2.0];
    /// let mut samples = Vec::new();
    /// let solution = Dop853::new(Options::with_tolerance(1e-10)).sample(
    ///     &decay,
    ///     &State::new(0.0, vec![1.0]),
    ///     &times,
    ///     |time, y| samples.push((time, y[0])),
    /// )?;
    /// assert_eq!(samples.len(), times.len());
    /// for (time, y) in samples {
    ///     assert!((y - (-time).exp()).abs() < 1e-9);
    /// }
    /// assert_eq!(solution.state.time, 2.0);
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    fn sample(
        &self,
        ode: &O,
        start: &State<T>,
        times: &[T],
        mut visit: impl FnMut(T, &[T]),
    ) -> Result<Solution<T>, IntegrationError<T>> {
        let visit = |time, values: &[T]| {
            visit(time, values);
            Ok::<_, Infallible>(())
        };
        Ok(self.try_sample(ode, start, times, visit)?)
    }

    /// Integrates like [`sample`](Self::sample), with a function `visit` that can return an error,
    /// which ends the run.
    ///
    /// # Errors
    ///
    /// As [`sample`](Self::sample), and [`RunError::Observer`] with the error of the visitor and
    /// the state that it was called with.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::integrate::RunError;
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
    /// let start = State::new(0.0, vec![1.0]);
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let mut room = 2;
    /// let write = |_: f64, _: &[f64]| {
    ///     room -= 1;
    ///     if room > 0 { Ok(()) } else { Err("the disk is full") }
    /// };
    /// let run = method.try_sample(&decay, &start, &[0.0, 0.5, 1.0], write);
    /// let Err(RunError::Observer { error, last, .. }) = run else {
    ///     panic!("there is no room for three");
    /// };
    /// assert_eq!((error, last.time), ("the disk is full", 0.5));
    /// ```
    fn try_sample<E>(
        &self,
        ode: &O,
        start: &State<T>,
        times: &[T],
        mut visit: impl FnMut(T, &[T]) -> Result<(), E>,
    ) -> Result<Solution<T>, RunError<T, E>> {
        let mut run = Run::new(self, ode, start, times)?;
        let mut pending = times.iter().copied().peekable();
        while let Some(time) = pending.next_if(|&time| time == start.time) {
            visit(time, &start.values)
                .map_err(|error| run.stopped_at(time, &start.values, error))?;
        }
        let goal = run.goal(times.last().copied().unwrap_or(start.time));
        let mut values = start.values.clone();
        while let Some(mut step) = run.step_to(goal)? {
            while let Some(time) = pending.next_if(|&time| step.contains(time)) {
                if let Err(error) = step.eval(time, &mut values) {
                    return Err(run.dense_failure(error).into());
                }
                if let Err(error) = visit(time, &values) {
                    return Err(run.stopped_at(time, &values, error));
                }
            }
        }
        Ok(run.solution(StopReason::EndReached))
    }

    /// Returns the states at the given times, as [`sample`](Self::sample) computes them.
    ///
    /// # Errors
    ///
    /// As [`sample`](Self::sample).
    fn sample_to_vec(
        &self,
        ode: &O,
        start: &State<T>,
        times: &[T],
    ) -> Result<Vec<State<T>>, IntegrationError<T>> {
        let mut states = Vec::with_capacity(times.len());
        self.sample(ode, start, times, |time, values| {
            states.push(State::new(time, values.to_vec()));
        })?;
        Ok(states)
    }

    /// Returns the motion from `start` to the time `end`, which can be evaluated at any time
    /// between.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate). To keep the part before an error,
    /// [`push`](Trajectory::push) the steps in an observer.
    fn trajectory(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
    ) -> Result<Trajectory<T>, IntegrationError<T>> {
        let mut run = Run::to_end(self, ode, start, end)?;
        let mut trajectory = Trajectory::new(start.clone());
        let goal = run.goal(end);
        while let Some(mut step) = run.step_to(goal)? {
            if let Err(error) = trajectory.push(&mut step) {
                return Err(run.dense_failure(error));
            }
        }
        Ok(trajectory)
    }

    /// Integrates from `start` to the time `end` and calls `visit` with every
    /// zero crossing of the functions `events`, in the order of the run.
    ///
    /// [`ControlFlow::Break`] and [`Event::with_terminal`] end the run there: the last
    /// state is then that of the crossing. All other crossings at that time, to its
    /// rounding, are reported before the run ends, so that a run that starts from that
    /// state, forwards or backwards, reports none again and misses none.
    ///
    /// If a run starts at a zero (to the rounding of the time), no crossing is reported there. A
    /// function that touches zero without changing sign is reported only if a check hits the zero
    /// exactly.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate), and [`IntegrationError::Event`] if a
    /// function returns NaN.
    ///
    /// # Examples
    ///
    /// A Poincaré section: the angle of a pendulum whenever its velocity
    /// changes from positive to negative.
    ///
    /// ```
    /// use branched_pendulum::integrate::{Crossing, Event};
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let pendulum = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
    ///     rates[0] = y[1];
    ///     rates[1] = -y[0].sin();
    /// });
    /// let velocity = |_time: f64, y: &[f64]| y[1];
    /// let turns = [Event::new(Crossing::Falling, &velocity)];
    /// let mut angles = Vec::new();
    /// Dop853::new(Options::with_tolerance(1e-12)).integrate_with_events(
    ///     &pendulum,
    ///     &State::at_rest(0.0, &[1.0]),
    ///     20.0,
    ///     &turns,
    ///     |turn| {
    ///         angles.push(turn.state[0]);
    ///         ControlFlow::Continue(())
    ///     },
    /// )?;
    /// assert_eq!(angles.len(), 2);
    /// assert!(angles.iter().all(|angle| (angle - 1.0).abs() < 1e-11));
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    fn integrate_with_events(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        events: &[Event<'_, T>],
        mut visit: impl FnMut(Occurrence<'_, T>) -> ControlFlow<()>,
    ) -> Result<Solution<T>, IntegrationError<T>> {
        let visit = |occurrence: Occurrence<'_, T>| Ok::<_, Infallible>(visit(occurrence));
        Ok(self.try_integrate_with_events(ode, start, end, events, visit)?)
    }

    /// Integrates like [`integrate_with_events`](Self::integrate_with_events), with a function
    /// `visit` that can return an error, which ends the run.
    ///
    /// # Errors
    ///
    /// As [`integrate_with_events`](Self::integrate_with_events), and [`RunError::Observer`] with
    /// the error of the visitor and the state at the crossing.
    fn try_integrate_with_events<E>(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        events: &[Event<'_, T>],
        visit: impl FnMut(Occurrence<'_, T>) -> Result<ControlFlow<()>, E>,
    ) -> Result<Solution<T>, RunError<T, E>> {
        Run::to_end(self, ode, start, end)?.find(end, events, visit)
    }
}
