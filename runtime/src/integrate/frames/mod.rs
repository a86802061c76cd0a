//! Motion in real time: frame by frame, whatever happens.

mod limit;

use core::convert::Infallible;

use super::error::InputError;
use super::fixed::Rk4Step;
use super::request::{all_finite, check_start};
use super::right_hand_side::{RightHandSide, StepSpan};
use crate::scalar::Real;
use crate::system::{Ode, State, Workspace};

pub use limit::longest_sub_step;

/// Largest change of an angle in a longest sub-step, rad: what the rates are limited to.
const LARGEST_TURN: f64 = 0.5;

/// Length of the longest frame, s.
const LONGEST_FRAME: f64 = 1.0;

/// A motion in frames that cannot fail: for games, exhibits and controllers.
///
/// [`advance`](Self::advance) cuts a frame into equal sub-steps of the classical
/// Runge–Kutta method, as few as are not longer than the sub-step of the start. With
/// that of [`longest_sub_step`] they are stable at rest at any angles, and short enough
/// that the motion hardly depends on the rate of frames: for a branch of 31 links it is
/// within 1e-3 rad over a second at 30, 60 and 144 frames a second, which a test asks
/// for. A sub-step takes four evaluations. Nothing is allocated after the start, and
/// nothing is kept from one frame to the next but state and time, so that state and
/// equations may be changed between any two.
///
/// For a state of angles and their rates, as [`AbsoluteAngles`] and [`UnderTorques`] have
/// it: the second half of the components are the rates of the first.
///
/// # In excess
///
/// Rates are limited to half a radian in a longest sub-step. Beyond, all are made
/// smaller by one factor, which takes kinetic energy away and adds none. A sub-step that
/// cannot be made like that, after a hit of 10⁶ N for example, is one of Euler's method
/// with its rates limited in the same way; and where not even the accelerations are
/// finite, the links stop where they are. So the state stays finite, and its energy is
/// bounded by that of the largest rates: [`limited`](Self::limited) counts the sub-steps
/// that were not plain ones.
///
/// A frame longer than a second is one of a second, and one that is negative or no
/// number is none.
///
/// Where friction is so strong that sub-steps get too many, [`Gauss::for_animation`]
/// solves for steps as long as a frame instead; where frames fail, [`Stepper`] says why.
///
/// Source of the limit of stability: Hairer, Wanner, *Solving ODEs II*, 2nd edition,
/// Springer 1996, section IV.2.
///
/// [`AbsoluteAngles`]: crate::system::AbsoluteAngles
/// [`Gauss::for_animation`]: super::Gauss::for_animation
/// [`Stepper`]: super::Stepper
/// [`UnderTorques`]: crate::system::UnderTorques
///
/// # Examples
///
/// A branch that a hand pulls and lets go:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::integrate::{Frames, longest_sub_step};
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::UnderTorques;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5, friction = 0.05) [
///         twig: rod(mass = 0.1, length = 0.3, friction = 0.002) * 2
///     ],
///     emit(forces),
/// )]
/// struct Branch;
///
/// let branch = Branch::<f32>::default();
/// let rest = State::at_rest(0.0, &[0.0; 3]);
/// let sub_step = longest_sub_step(&branch);
/// let mut frames = Frames::new(UnderTorques::of(&branch, vec![0.0; 3]), &rest, sub_step)?;
/// for number in 0..120 {
///     frames.ode_mut().torques_mut()[0] = if number < 60 { 0.5 } else { 0.0 };
///     frames.advance(1.0 / 60.0);
/// }
/// assert!(frames.state()[0].abs() > 0.01);
///
/// // A hit that no branch would survive.
/// frames.ode_mut().torques_mut()[1] = 1e6;
/// frames.advance(1.0 / 60.0);
/// assert!(frames.limited() > 0 && frames.state().iter().all(|value| value.is_finite()));
/// # Ok::<(), branched_pendulum::integrate::InputError<f32>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Frames<O, T> {
    ode: O,
    workspace: Workspace<T>,
    /// In `f64`, so that frames add up to hours in any `T`.
    time: f64,
    /// Longest sub-step, s.
    sub_step: f64,
    largest_rate: T,
    limited: u64,
    /// The state, and the end of a sub-step that may become it.
    step: Rk4Step<T>,
}

/// The equations, finite or not.
struct FrameSystem<'a, O, T> {
    ode: &'a O,
    workspace: &'a mut Workspace<T>,
    dimension: usize,
}

impl<O: Ode<T>, T: Real> RightHandSide<T> for FrameSystem<'_, O, T> {
    type Failure = Infallible;

    #[inline(always)]
    fn dimension(&self) -> usize {
        self.dimension
    }

    #[inline(always)]
    fn write(&mut self, time: T, state: &[T], rates: &mut [T]) {
        self.ode.rates_with(self.workspace, time, state, rates);
    }

    #[inline(always)]
    fn evaluate(
        &mut self,
        _stage: usize,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) -> Result<(), Infallible> {
        self.write(time, state, rates);
        Ok(())
    }
}

impl<O: Ode<T>, T: Real> Frames<O, T> {
    /// A motion from `start`, whose sub-steps are no longer than `sub_step` (s).
    ///
    /// # Errors
    ///
    /// [`InputError`] if the start is not finite or does not fit the equations, or if
    /// the sub-step is not positive and finite.
    pub fn new(ode: O, start: &State<T>, sub_step: T) -> Result<Self, InputError<T>> {
        check_start(&ode, (start.time, &start.values))?;
        if !(sub_step.is_finite() && sub_step > T::ZERO) {
            return Err(InputError::Step {
                name: "longest",
                value: sub_step,
            });
        }
        Ok(Self {
            ode,
            workspace: Workspace::new(),
            time: start.time.to_f64(),
            sub_step: sub_step.to_f64(),
            largest_rate: T::from_f64(LARGEST_TURN) / sub_step,
            limited: 0,
            step: Rk4Step::new(start.values.clone()),
        })
    }

    /// Moves on by `duration` (s), the length of a frame.
    pub fn advance(&mut self, duration: T) {
        let duration = duration.to_f64();
        if duration.is_nan() || duration <= 0.0 {
            return;
        }
        let duration = duration.min(LONGEST_FRAME);
        // As many as are needed, but none more for rounding.
        let ratio = duration / self.sub_step;
        let whole = ratio as u64;
        let count = whole + u64::from(ratio - whole as f64 > 1e-6 || whole == 0);
        let length = duration / count as f64;
        let start = self.time;
        for number in 0..count {
            self.time = start + number as f64 * length;
            self.sub_step(T::from_f64(length));
        }
        self.time = start + duration;
    }

    /// The state.
    pub fn state(&self) -> &[T] {
        &self.step.start
    }

    /// Time of the state, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The equations.
    pub fn ode(&self) -> &O {
        &self.ode
    }

    /// The equations, to change them.
    pub fn ode_mut(&mut self) -> &mut O {
        &mut self.ode
    }

    /// Number of sub-steps so far in which rates were limited.
    pub fn limited(&self) -> u64 {
        self.limited
    }

    /// Rate, rad/s, that none exceeds after a sub-step.
    pub fn largest_rate(&self) -> T {
        self.largest_rate
    }

    /// Goes on from another time and state.
    ///
    /// # Errors
    ///
    /// [`InputError`] if they are not finite or of another length; nothing has changed
    /// then.
    pub fn set_state(&mut self, time: f64, values: &[T]) -> Result<(), InputError<T>> {
        check_start(&self.ode, (T::from_f64(time), values))?;
        let own = &mut self.step.start;
        if values.len() != own.len() {
            return Err(InputError::Dimension {
                expected: own.len(),
                found: values.len(),
            });
        }
        own.copy_from_slice(values);
        self.time = time;
        Ok(())
    }

    fn sub_step(&mut self, length: T) {
        self.runge_kutta(length);
        let limit = self.largest_rate;
        let Rk4Step { start, end, .. } = &mut self.step;
        let n = start.len() / 2;
        let (angles, rates) = end.split_at(n);
        // False for a rate that is no number.
        let slow = rates
            .iter()
            .fold(true, |slow, rate| slow & (rate.abs() <= limit));
        if slow && all_finite(angles) {
            core::mem::swap(start, end);
            return;
        }
        self.limited += 1;
        // The end of the sub-step counts where angles have not run away on its way.
        let turn = T::from_f64(2.0) * limit * length;
        let pairs = start.iter().zip(&*end).take(n);
        let within = pairs.fold(true, |within, (a, b)| within & ((*b - *a).abs() <= turn));
        if within && all_finite(end) {
            let factor = limit / size(rates).max(limit);
            start.copy_from_slice(end);
            start[n..]
                .iter_mut()
                .for_each(|rate| *rate = factor * *rate);
        } else {
            self.limited_euler(length);
        }
    }

    /// Makes a step of the classical Runge–Kutta method, whose end may be anything.
    fn runge_kutta(&mut self, length: T) {
        let time = T::from_f64(self.time);
        let system = &mut FrameSystem {
            ode: &self.ode,
            workspace: &mut self.workspace,
            dimension: self.step.start.len(),
        };
        let span = StepSpan { time, step: length };
        let Ok(()) = self.step.evaluate_start(system, time);
        let Ok(()) = self.step.make_end(system, span);
    }

    /// Makes a sub-step of the symplectic Euler method with limited rates, from the rates at
    /// the start; links stop where accelerations are not finite.
    fn limited_euler(&mut self, length: T) {
        let Rk4Step {
            start, start_rates, ..
        } = &mut self.step;
        let (angles, rates) = start.split_at_mut(start_rates.len() / 2);
        let accelerations = &start_rates[angles.len()..];
        // Of the sum, infinity is left out by the size of its terms.
        let largest = size(rates) + length * size(accelerations);
        if !(largest.is_finite() && all_finite(accelerations)) {
            rates.fill(T::ZERO);
            return;
        }
        for (rate, &acceleration) in rates.iter_mut().zip(accelerations) {
            *rate += length * acceleration;
        }
        let largest = size(rates);
        if largest > self.largest_rate {
            let factor = self.largest_rate / largest;
            rates.iter_mut().for_each(|rate| *rate = factor * *rate);
        }
        for (angle, &rate) in angles.iter_mut().zip(&*rates) {
            *angle += length * rate;
        }
    }
}

/// Largest absolute value; numbers that are none do not count.
fn size<T: Real>(values: &[T]) -> T {
    values
        .iter()
        .fold(T::ZERO, |size, value| size.max(value.abs()))
}
