//! A motion that advances step by step or frame by frame, when the caller requests it.

use alloc::vec::Vec;
use core::fmt;

use super::checkpoint::Checkpoint;
use super::dense::{DenseStep, Made};
use super::error::{InputError, IntegrationError};
use super::integrator::Integrator;
use super::report::Report;
use super::request::{check_end, check_start};
use super::run::Run;
use crate::scalar::Real;
use crate::scalar::two_sum;
use crate::system::{Ode, State};

/// A motion that the caller advances step by step or frame by frame; created by
/// [`Integrator::start`].
///
/// It keeps the memory of the method: rates, step length, factors of Newton's method. After the
/// start only errors allocate.
///
/// - [`advance`](Self::advance) advances the time by the length of a frame. The length of the
///   steps does not depend on the frames; the state at a frame comes from the dense output. So the
///   motion is the same at any frame rate.
/// - [`step`](Self::step) makes one step of the length that the method chooses.
/// - [`step_to`](Self::step_to) makes one step that ends at a given time at the latest, as the
///   steps of [`Integrator::integrate`] do.
///
/// State and equations may be changed between requests: [`set_state`](Self::set_state),
/// [`ode_mut`](Self::ode_mut). Step limits count the steps of one request.
///
/// The equations may be borrowed (`&ode` is an [`Ode`] too) or owned.
///
/// # Examples
///
/// A rod that a hand pushes while it swings:
///
/// ```
/// use branched_pendulum::integrate::Stepper;
/// use branched_pendulum::prelude::*;
///
/// struct Rod {
///     push: f64,
/// }
///
/// impl Ode<f64> for Rod {
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn rates(&self, _time: f64, state: &[f64], rates: &mut [f64]) {
///         rates[0] = state[1];
///         rates[1] = self.push - 14.7 * state[0].sin();
///     }
/// }
///
/// struct Game {
///     rod: Stepper<Gauss<f64>, Rod>,
/// }
///
/// let frame = 1.0 / 60.0;
/// let method = Gauss::for_animation(frame);
/// let rest = State::at_rest(0.0, &[0.0]);
/// let mut game = Game { rod: method.start(Rod { push: 0.0 }, &rest)? };
/// for number in 0..120 {
///     if number == 60 {
///         game.rod.ode_mut().push = 3.0;
///     }
///     game.rod.advance(frame)?;
///     assert_eq!(game.rod.state()[0] != 0.0, number >= 60);
/// }
/// assert!((game.rod.time() - 2.0).abs() < 1e-15);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
///
/// Steps in a loop that can fail for other reasons:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
/// let method = Dop853::new(Options::with_tolerance(1e-10));
/// let mut stepper = method.start(&decay, &State::new(0.0, vec![1.0]))?;
/// let mut text = Vec::new();
/// while let Some(step) = stepper.step_to(1.0)? {
///     use std::io::Write;
///     writeln!(text, "{} {}", step.end_time(), step.end()[0])?;
/// }
/// assert!((stepper.state()[0] - (-1.0_f64).exp()).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Stepper<M, O, T = f64>
where
    T: Real,
    O: Ode<T>,
    M: Integrator<T, O>,
{
    run: Run<O, O, M::Steps, T>,
    /// Direction of the run: 1 forwards, −1 backwards in time.
    direction: T,
    /// Time to which the caller has advanced the motion, and the accumulated rounding error of this
    /// sum.
    time: T,
    residue: T,
    /// True if the caller's time is within the last step; `inside` is then the state at that time.
    is_inside: bool,
    inside: Vec<T>,
    /// True if the caller has changed the state or the equations since the last step.
    changed: bool,
}

impl<T: Real, O: Ode<T>, M: Integrator<T, O>> Stepper<M, O, T> {
    pub(super) fn new(method: &M, ode: O, start: &State<T>) -> Result<Self, IntegrationError<T>> {
        Ok(Self {
            run: Run::new(method, ode, start, &[])?,
            direction: T::ONE,
            time: start.time,
            residue: T::ZERO,
            is_inside: false,
            inside: start.values.clone(),
            changed: false,
        })
    }

    pub(super) fn resumed(
        method: &M,
        ode: O,
        checkpoint: &Checkpoint<T>,
    ) -> Result<Self, IntegrationError<T>> {
        let Checkpoint {
            time,
            residue,
            reached,
            direction,
            report,
            memory,
        } = checkpoint;
        let mut stepper = Self::new(method, ode, reached)?;
        stepper.run.restore(memory, report)?;
        (stepper.time, stepper.residue) = (*time, *residue);
        stepper.direction = *direction;
        Ok(stepper)
    }

    /// Returns a checkpoint of the motion. From here on, this motion and a motion that
    /// [`Integrator::resume`] continues from the checkpoint have the same bits.
    ///
    /// Between two steps this does not change the motion. At a frame within a step, and after
    /// changes of state or equations, the method restarts from the present state, in both motions.
    ///
    /// # Errors
    ///
    /// [`InputError::Dimension`] if the dimension of the equations has changed.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    ///
    /// let swing = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
    ///     rates[0] = y[1];
    ///     rates[1] = -y[0].sin();
    /// });
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let mut stepper = method.start(&swing, &State::new(0.0, vec![2.0, 0.0]))?;
    /// for _ in 0..10 {
    ///     stepper.step()?;
    /// }
    /// let mut other = method.resume(&swing, &stepper.checkpoint()?)?;
    /// for _ in 0..100 {
    ///     assert_eq!(other.step()?.end(), stepper.step()?.end());
    /// }
    /// assert_eq!(other.report(), stepper.report());
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    pub fn checkpoint(&mut self) -> Result<Checkpoint<T>, InputError<T>> {
        if self.changed || self.is_inside {
            self.start_anew(self.direction)?;
        }
        let memory = self.run.save();
        Ok(Checkpoint {
            time: self.time,
            residue: self.residue,
            reached: State::new(self.run.time(), self.run.state().to_vec()),
            direction: self.direction,
            report: *self.run.report(),
            memory,
        })
    }

    /// Returns the time of the state.
    pub fn time(&self) -> T {
        self.time
    }

    /// Returns the state.
    pub fn state(&self) -> &[T] {
        if self.is_inside {
            &self.inside
        } else {
            self.run.state()
        }
    }

    /// Returns time and state, for instance as a new start. Allocates.
    pub fn to_state(&self) -> State<T> {
        State {
            time: self.time,
            values: self.state().to_vec(),
        }
    }

    /// Returns the report of all steps so far.
    pub fn report(&self) -> &Report<T> {
        self.run.report()
    }

    /// Returns the equations.
    pub fn ode(&self) -> &O {
        &self.run.ode
    }

    /// Returns the equations, so that they can be changed. The next step restarts from the present
    /// state.
    pub fn ode_mut(&mut self) -> &mut O {
        self.changed = true;
        &mut self.run.ode
    }

    /// Continues from another time and state.
    ///
    /// # Errors
    ///
    /// [`InputError`] if they are not finite or have another length. Nothing changes in that case.
    pub fn set_state(&mut self, time: T, values: &[T]) -> Result<(), InputError<T>> {
        check_start(&self.run.ode, (time, values))?;
        check_length(self.inside.len(), values.len())?;
        self.inside.copy_from_slice(values);
        (self.time, self.residue) = (time, T::ZERO);
        (self.is_inside, self.changed) = (true, true);
        Ok(())
    }

    /// Makes the next step, with the length that the method chooses, and returns it. The state is
    /// then the state at its end.
    ///
    /// # Errors
    ///
    /// As [`Integrator::integrate`]. State and time are then the last good ones; they can be
    /// changed, or the motion can continue from them.
    pub fn step(&mut self) -> Result<DenseStep<'_, T>, IntegrationError<T>> {
        self.make_step(None, self.direction)?;
        Ok(DenseStep::new(&mut self.run))
    }

    /// Makes the next step, at most to the time `end`, and returns it; `None` if `end` has been
    /// reached. `end` may lie before the present time.
    ///
    /// # Errors
    ///
    /// As [`step`](Self::step), and if `end` is not finite.
    pub fn step_to(&mut self, end: T) -> Result<Option<DenseStep<'_, T>>, IntegrationError<T>> {
        check_end(end)?;
        if end == self.time {
            return Ok(None);
        }
        let direction = if end > self.time { T::ONE } else { -T::ONE };
        self.make_step(Some(end), direction)?;
        Ok(Some(DenseStep::new(&mut self.run)))
    }

    /// Returns an iterator over the states at the ends of the steps to the time `end`. It ends
    /// after an error. Each state is allocated; [`step_to`](Self::step_to) allocates nothing.
    pub fn states_to(
        &mut self,
        end: T,
    ) -> impl Iterator<Item = Result<State<T>, IntegrationError<T>>> {
        let mut failed = false;
        core::iter::from_fn(move || {
            if failed {
                return None;
            }
            match self.step_to(end) {
                Ok(None) => return None,
                Ok(Some(_)) => {}
                Err(error) => {
                    failed = true;
                    return Some(Err(error));
                }
            }
            Some(Ok(self.to_state()))
        })
    }

    /// Advances time and state by `duration` (backwards if negative).
    ///
    /// The sum of the times is compensated, so that n frames lead to n times their length without
    /// added rounding.
    ///
    /// # Errors
    ///
    /// As [`step`](Self::step), and if `duration` is not finite. If a step fails, time and state
    /// are those at the end of the step before.
    pub fn advance(&mut self, duration: T) -> Result<(), IntegrationError<T>> {
        if !duration.is_finite() {
            return Err(InputError::FixedStep { value: duration }.into());
        }
        if duration == T::ZERO {
            return Ok(());
        }
        let direction = if duration > T::ZERO { T::ONE } else { -T::ONE };
        if self.changed || direction != self.direction {
            self.start_anew(direction)?;
        }
        let (time, residue) = two_sum(self.time, duration + self.residue);
        let goal = self.run.goal_towards(None, direction);
        // Ends of steps and frames of equal length agree except for rounding.
        let rounding = T::from_f64(2.0) * T::EPSILON * time.abs();
        while (time - self.run.time()) * direction > rounding {
            if let Err(error) = self.run.step(goal) {
                self.stay();
                return Err(error);
            }
        }
        self.is_inside = (self.run.time() - time) * direction > rounding;
        (self.time, self.residue) = (time, residue);
        if self.is_inside {
            let value = DenseStep::new(&mut self.run).eval(time, &mut self.inside);
            if let Err(error) = value {
                self.stay();
                return Err(self.run.dense_failure(error));
            }
        }
        Ok(())
    }

    /// Makes a step from the present time and state of the caller.
    fn make_step(&mut self, end: Option<T>, direction: T) -> Result<(), IntegrationError<T>> {
        if self.changed || self.is_inside || direction != self.direction {
            self.start_anew(direction)?;
        }
        let goal = self.run.goal_towards(end, direction);
        let made = self.run.step(goal);
        self.stay();
        made
    }

    /// Sets the caller's time and state to the end of the last step.
    fn stay(&mut self) {
        (self.time, self.residue) = (self.run.time(), T::ZERO);
        self.is_inside = false;
    }

    /// Restarts the method from the present state, in the given direction of time.
    fn start_anew(&mut self, direction: T) -> Result<(), InputError<T>> {
        check_length(self.run.ode.dimension(), self.inside.len())?;
        if !self.is_inside {
            self.inside.copy_from_slice(self.run.state());
        }
        self.run.restart(self.time, &self.inside);
        self.direction = direction;
        (self.is_inside, self.changed) = (false, false);
        Ok(())
    }
}

fn check_length<T>(expected: usize, found: usize) -> Result<(), InputError<T>> {
    if expected == found {
        Ok(())
    } else {
        Err(InputError::Dimension { expected, found })
    }
}

impl<T: Real, O: Ode<T>, M: Integrator<T, O>> fmt::Debug for Stepper<M, O, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Stepper")
            .field("time", &self.time)
            .field("state", &self.state())
            .field("report", self.report())
            .finish_non_exhaustive()
    }
}
