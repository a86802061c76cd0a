//! Gradients of costs of a motion: the discrete adjoint of Runge–Kutta methods.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

mod explicit;
mod gauss;
mod reverse;
mod tape;

use alloc::vec;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::ops::ControlFlow;

pub use self::reverse::{Reverse, StepAdjoint};
use self::reverse::{largest, non_finite};
use self::tape::Tape;
use super::integrator::Integrator;
use super::request::{check_start, check_times};
use super::{Crossing, Event, IntegrationError, StopReason};
use crate::scalar::Real;
use crate::system::{PullbackOde, State};

/// A cost of a motion and its derivatives, as [`AdjointMethod::gradient`] returns them.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionGradient<T> {
    /// Sum of the costs of all samples.
    pub cost: T,
    /// Derivatives of the cost by the components of the start state.
    pub start: Vec<T>,
    /// Derivatives of the cost by the parameters of the equations.
    pub parameters: Vec<T>,
    /// Amplification of small changes by the motion: the largest derivative of the cost by a state
    /// on the way, relative to the largest derivative of a sample's cost by the state there. If the
    /// product of this number and the relative tolerance is not far below 1, the derivatives say
    /// nothing about the motion.
    pub growth: T,
    /// Number of steps of the motion.
    pub steps: usize,
}

/// A method with derivatives of motions in reverse mode: the explicit pairs
/// ([`Dopri5`](super::Dopri5), [`Dop853`](super::Dop853), [`Verner98`](super::Verner98)) and
/// [`Gauss`](super::Gauss).
///
/// The derivatives are those of the numerical solution with its steps kept fixed (the discrete
/// adjoint), exact but for rounding. A step is differentiated backwards through its stages; in
/// [`Gauss`](super::Gauss) the equations for their adjoints are iterated as those of the stages are.
///
/// In a chaotic motion the derivatives grow as fast as two nearby motions separate, and are of no
/// use once these are apart. [`MotionGradient::growth`] says how far they grew.
///
/// Other crates cannot implement this trait.
///
/// Source: Sanz-Serna, SIAM Review 58 (2016) 3–33.
pub trait AdjointMethod<T: Real> {
    /// Adjoint of one step of the method.
    #[doc(hidden)]
    type Step: StepAdjoint<T>;

    /// Creates the adjoint of steps, for states of this number of components.
    #[doc(hidden)]
    fn step_adjoint(&self, dimension: usize) -> Self::Step;

    /// Returns the sum of the costs of a motion at given `times`, and its derivatives by the start
    /// state and by the `parameters` (their number) of the equations.
    ///
    /// `cost` receives the index of a time, the state there, and a slice of zeros to which it
    /// writes the derivatives of its result by the state. The times are in the direction of the
    /// motion, and steps end at each of them.
    ///
    /// Time: of the explicit pairs one run, one repetition, and one pullback for each stage; of
    /// [`Gauss`](super::Gauss) one run, and as many pullbacks as evaluations. The number of
    /// parameters does not count. Memory: one state for each time, two numbers for each step, and the
    /// states of at most 4096 steps; the steps between these are made once more. Of
    /// [`Gauss`](super::Gauss) all states are kept, with those of the stages.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] as [`Integrator::integrate`].
    /// [`InputError::Parameters`](super::InputError::Parameters) if the equations have another number
    /// of parameters; [`IntegrationError::NonFinite`] if a derivative is not finite;
    /// [`IntegrationError::NotSolved`] if the equations for the adjoints of a step of
    /// [`Gauss`](super::Gauss) do not converge by fixed-point iteration: take shorter steps.
    ///
    /// # Examples
    ///
    /// The derivative of exp(k t) by its start and by the rate k:
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::{PullbackOde, PullbackWorkspace};
    ///
    /// struct Growth(f64);
    ///
    /// impl Ode<f64> for Growth {
    ///     fn dimension(&self) -> usize {
    ///         1
    ///     }
    ///     fn rates(&self, _: f64, state: &[f64], rates: &mut [f64]) {
    ///         rates[0] = self.0 * state[0];
    ///     }
    /// }
    ///
    /// impl PullbackOde<f64> for Growth {
    ///     fn add_pullback(
    ///         &self,
    ///         _: &mut PullbackWorkspace<f64>,
    ///         _: f64,
    ///         state: &[f64],
    ///         weights: &[f64],
    ///         state_adjoint: &mut [f64],
    ///         parameters_adjoint: &mut [f64],
    ///     ) {
    ///         state_adjoint[0] += self.0 * weights[0];
    ///         parameters_adjoint[0] += state[0] * weights[0];
    ///     }
    /// }
    ///
    /// let method = Dop853::new(Options::with_tolerance(1e-12));
    /// let start = State::new(0.0, vec![1.0]);
    /// let end = |_: usize, state: &[f64], slopes: &mut [f64]| {
    ///     slopes[0] = 1.0;
    ///     state[0]
    /// };
    /// let gradient = method.gradient(&Growth(0.5), 1, &start, &[2.0], end)?;
    /// let e = 1.0_f64.exp();
    /// assert!((gradient.cost - e).abs() < 1e-11);
    /// assert!((gradient.start[0] - e).abs() < 1e-11);
    /// assert!((gradient.parameters[0] - 2.0 * e).abs() < 1e-11);
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    fn gradient<O: PullbackOde<T> + ?Sized>(
        &self,
        ode: &O,
        parameters: usize,
        start: &State<T>,
        times: &[T],
        mut cost: impl FnMut(usize, &[T], &mut [T]) -> T,
    ) -> Result<MotionGradient<T>, IntegrationError<T>>
    where
        Self: Integrator<T, O> + Sized,
    {
        self.gradient_of_samples(ode, parameters, start, times, |samples, slopes| {
            let all = samples.iter().zip(slopes).enumerate();
            all.fold(T::ZERO, |sum, (index, (sample, slopes))| {
                sum + cost(index, sample, slopes)
            })
        })
    }

    /// Returns a cost that depends on the states of a motion at all `times` together, with its
    /// derivatives, as [`gradient`](Self::gradient).
    ///
    /// `cost` receives the states, and for each of them a vector of zeros to which it writes the
    /// derivatives of its result by this state.
    ///
    /// # Errors
    ///
    /// As [`gradient`](Self::gradient).
    fn gradient_of_samples<O: PullbackOde<T> + ?Sized>(
        &self,
        ode: &O,
        parameters: usize,
        start: &State<T>,
        times: &[T],
        cost: impl FnOnce(&[Vec<T>], &mut [Vec<T>]) -> T,
    ) -> Result<MotionGradient<T>, IntegrationError<T>>
    where
        Self: Integrator<T, O> + Sized,
    {
        check_start(ode, (start.time, &start.values))?;
        check_times(start.time, times)?;
        let mut reverse = Reverse::new(start.values.len(), parameters);
        reverse.check_parameters(ode, start)?;
        let mut adjoint = self.step_adjoint(start.values.len());
        let Forward {
            mut tape,
            counts,
            samples,
        } = forward(self, &adjoint, ode, start, times)?;
        let mut slopes = vec![vec![T::ZERO; start.values.len()]; samples.len()];
        let total = cost(&samples, &mut slopes);
        let given = largest(slopes.iter().flatten());
        for (before, slopes) in counts.iter().zip(&slopes).rev() {
            tape.back_to(*before, &mut adjoint, &mut reverse, ode)?;
            for (adjoint, slope) in reverse.adjoint.iter_mut().zip(slopes) {
                *adjoint += *slope;
            }
        }
        tape.back_to(0, &mut adjoint, &mut reverse, ode)?;
        let gradient = MotionGradient {
            cost: total,
            start: reverse.adjoint,
            parameters: reverse.parameters,
            growth: match given > T::ZERO {
                true => reverse.largest / given,
                false => T::ZERO,
            },
            steps: tape.steps(),
        };
        let mut all = gradient.start.iter().chain(&gradient.parameters);
        match all.all(|slope| slope.is_finite()) && total.is_finite() {
            true => Ok(gradient),
            false => Err(non_finite(start)),
        }
    }

    /// Returns the first time at which a function of the state crosses zero, and the derivatives of
    /// this time by the start state and by the `parameters` (their number) of the equations; `None`
    /// if the function does not cross zero before the time `end`. The result's `cost` is the time.
    ///
    /// `function` returns the value at a state and writes its derivatives by the components to a
    /// slice of zeros. With a crossing at time t and state y the derivatives of t are those of
    /// −g(y) / (∇g · f), where f are the rates there.
    ///
    /// Time and memory: those of [`gradient`](Self::gradient), and one more run.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] as [`gradient`](Self::gradient); [`IntegrationError::NonFinite`] also if
    /// the function touches zero without crossing it, where its time has no derivatives.
    fn gradient_of_crossing<O: PullbackOde<T> + ?Sized>(
        &self,
        ode: &O,
        parameters: usize,
        start: &State<T>,
        end: T,
        crossing: Crossing,
        function: impl Fn(&[T], &mut [T]) -> T,
    ) -> Result<Option<MotionGradient<T>>, IntegrationError<T>>
    where
        Self: Integrator<T, O> + Sized,
    {
        let memory = RefCell::new(vec![T::ZERO; start.values.len()]);
        let value = |_: T, state: &[T]| {
            let mut slopes = memory.borrow_mut();
            slopes.fill(T::ZERO);
            function(state, &mut slopes)
        };
        let event = Event::new(crossing, &value).with_terminal(1);
        let found =
            self.integrate_with_events(ode, start, end, &[event], |_| ControlFlow::Continue(()))?;
        if found.report.stop != StopReason::StoppedByEvent {
            return Ok(None);
        }
        let time = found.state.time;
        let cost = |_: usize, state: &[T], slopes: &mut [T]| {
            let _ = function(state, slopes);
            let mut rates = vec![T::ZERO; state.len()];
            ode.rates(time, state, &mut rates);
            let terms = rates.iter().zip(slopes.iter());
            let speed = terms.fold(T::ZERO, |sum, (rate, slope)| sum + *rate * *slope);
            for slope in slopes {
                *slope = -*slope / speed;
            }
            time
        };
        let gradient = self.gradient(ode, parameters, start, &[time], cost)?;
        Ok(Some(gradient))
    }
}

/// A run whose cost is differentiated.
struct Forward<T> {
    tape: Tape<T>,
    /// Number of steps before each sample.
    counts: Vec<usize>,
    /// States at the samples.
    samples: Vec<Vec<T>>,
}

/// Makes the run whose cost is differentiated, and keeps its steps.
fn forward<T: Real, O: PullbackOde<T> + ?Sized>(
    method: &impl Integrator<T, O>,
    adjoint: &impl StepAdjoint<T>,
    ode: &O,
    start: &State<T>,
    times: &[T],
) -> Result<Forward<T>, IntegrationError<T>> {
    let mut forward = Forward {
        tape: Tape::new(),
        counts: Vec::new(),
        samples: Vec::new(),
    };
    let mut reached = start.clone();
    for &time in times {
        if time != reached.time {
            let solution = method.integrate(ode, &reached, time, |step| {
                forward.tape.push(adjoint, step);
                ControlFlow::Continue(())
            })?;
            reached = solution.state;
        }
        forward.counts.push(forward.tape.steps());
        forward.samples.push(reached.values.clone());
    }
    Ok(forward)
}
