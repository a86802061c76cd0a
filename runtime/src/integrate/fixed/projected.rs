//! Projection of the state onto a level set of a first integral at the end of each step.

use alloc::vec;
use alloc::vec::Vec;

use super::gauss::GaussStep;
use super::grid::{Corrected, FixedStep, GridSteps};
use super::grid_position::Grid;
use super::rk4::Rk4Step;
use super::{Gauss, Rk4};
use crate::integrate::checkpoint::Memory;
use crate::integrate::error::InputError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::{Form, Piece};
use crate::integrate::steps::Failure;
use crate::scalar::Real;
use crate::system::{FirstIntegral, Ode, State};

/// A method whose state is projected onto the level set of a first integral, such as the energy,
/// after every step. The integral then keeps its initial value up to rounding.
///
/// Use this with care. The projection moves the state along the gradient of the integral until
/// the *value* of the integral is right. The order of the method does not change. But a Gauss
/// method with projection is neither symplectic nor symmetric, so that other invariants and the
/// structure of phase space may drift. An error perpendicular to the gradient (in phase) remains.
/// The energy no longer measures the accuracy of the run. Gauss methods do not need a projection,
/// since their energy does not drift. It serves methods whose energy drifts ([`Rk4`]), and
/// comparisons.
///
/// With g the gradient at the end ỹ of the step, y = ỹ + λ g is solved for the
/// level by Newton's method with the derivative at ỹ. This takes two or three evaluations of the
/// integral a step. Distances are Euclidean in the units of the state. Within a step the
/// correction grows in proportion to the time. Memory: four vectors of the state's length in
/// addition to the method's; steps allocate nothing.
///
/// A state that cannot be projected (the gradient vanishes, as at an equilibrium,
/// or the level is not reached) is treated as an unsolved step: the step is halved as often as
/// the method allows, then the run ends with
/// [`IntegrationError::NotProjected`](crate::integrate::IntegrationError::NotProjected).
///
/// Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd
/// edition, Springer 2006, section IV.4, algorithm 4.2; section V.4.1 on
/// the loss of structure.
///
/// # Examples
///
/// ```
/// use branched_pendulum::integrate::Projected;
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// // A pendulum: H = p²/2 − cos q.
/// let pendulum = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0].sin();
/// });
/// let energy = |y: &[f64], gradient: &mut [f64]| {
///     gradient[0] = y[0].sin();
///     gradient[1] = y[1];
///     0.5 * y[1] * y[1] - y[0].cos()
/// };
/// let start = State::at_rest(0.0, &[2.0]);
/// let method = Projected::new(Rk4::new(0.1), &energy);
/// let end = method.run(&pendulum, &start, 1000.0)?;
/// let mut gradient = [0.0; 2];
/// let error = energy(&end.state.values, &mut gradient) - energy(&start.values, &mut gradient);
/// assert!(error.abs() < 1e-14);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Projected<M, I, T = f64> {
    /// The method.
    pub method: M,
    /// First integral that keeps its initial value.
    pub integral: I,
    /// Largest accepted deviation of the integral from its level, relative to the larger of |level|
    /// and Σ |g_i y_i|, with the gradient g and the state y. Rounding of the state alone changes
    /// the integral by about the latter.
    pub tolerance: T,
    /// Number of Newton iterations after which the projection fails.
    pub iteration_limit: u32,
}

impl<M, I, T: Real> Projected<M, I, T> {
    /// Creates `method` with projection to a tolerance of eight [`Real::EPSILON`], in at most ten
    /// iterations.
    pub fn new(method: M, integral: I) -> Self {
        Self {
            method,
            integral,
            tolerance: T::from_f64(8.0) * T::EPSILON,
            iteration_limit: 10,
        }
    }

    fn projected<S>(
        &self,
        grid: Grid<T>,
        start: &State<T>,
        steps: S,
    ) -> Result<ProjectedSteps<S, I, T>, InputError<T>>
    where
        I: Clone,
    {
        let value = self.tolerance;
        if !(value.is_finite() && value > T::ZERO) {
            return Err(InputError::Tolerance {
                name: "projection",
                component: 0,
                value,
            });
        }
        let zeros = || vec![T::ZERO; start.values.len()];
        let step = ProjectedStep {
            steps,
            integral: self.integral.clone(),
            tolerance: self.tolerance,
            iteration_limit: self.iteration_limit,
            level: T::ZERO,
            gradient: zeros(),
            trial: zeros(),
            trial_gradient: zeros(),
            correction: zeros(),
        };
        Ok(GridSteps::new(step, grid.place()?))
    }
}

impl<T: Real, O: Ode<T> + ?Sized, I: FirstIntegral<T> + Clone> Integrator<T, O>
    for Projected<Gauss<T>, I, T>
{
    type Steps = ProjectedSteps<GaussStep<T, T>, I, T>;

    fn steps(&self, _ode: &O, start: &State<T>) -> Result<Self::Steps, InputError<T>> {
        let steps = GaussStep::new(&self.method, start.values.clone());
        self.projected(self.method.grid(), start, steps)
    }
}

impl<T: Real, O: Ode<T> + ?Sized, I: FirstIntegral<T> + Clone> Integrator<T, O>
    for Projected<Rk4<T>, I, T>
{
    type Steps = ProjectedSteps<Rk4Step<T>, I, T>;

    fn steps(&self, _ode: &O, start: &State<T>) -> Result<Self::Steps, InputError<T>> {
        let steps = Rk4Step::new(start.values.clone());
        self.projected(self.method.grid(), start, steps)
    }
}

/// Integrator that makes projected steps of constant length.
type ProjectedSteps<S, I, T> = GridSteps<ProjectedStep<S, I, T>, T>;

/// State of a method during a run, with the workspace of the projection.
#[derive(Clone, Debug)]
#[allow(unreachable_pub)]
pub struct ProjectedStep<S, I, T> {
    steps: S,
    integral: I,
    tolerance: T,
    iteration_limit: u32,
    /// Value of the first integral at the start of the run.
    level: T,
    gradient: Vec<T>,
    trial: Vec<T>,
    trial_gradient: Vec<T>,
    correction: Vec<T>,
}

impl<S, I: FirstIntegral<T>, T: Real> ProjectedStep<S, I, T> {
    /// Computes the correction that moves the end of the step to the level of the first integral,
    /// and writes it to `correction`.
    fn project<O: ?Sized>(&mut self, time: T, step: T) -> Result<(), Failure<T>>
    where
        S: Corrected<T, O>,
    {
        let end = self.steps.piece().end;
        self.correction.fill(T::ZERO);
        let mut deviation = self.integral.evaluate(end, &mut self.gradient) - self.level;
        let (mut square, mut size) = (T::ZERO, T::ZERO);
        for (&slope, &value) in self.gradient.iter().zip(end) {
            square += slope * slope;
            size += (slope * value).abs();
        }
        if !(deviation.is_finite() && square.is_finite()) {
            return Err(NonFinite::new(time, end).into());
        }
        let tolerated = self.tolerance * size.max(self.level.abs());
        let mut part = T::ZERO;
        let mut iterations = 0;
        while deviation.abs() > tolerated {
            let next = part - deviation / square;
            for ((trial, &value), &slope) in self.trial.iter_mut().zip(end).zip(&self.gradient) {
                *trial = value + next * slope;
            }
            let reached = self
                .integral
                .evaluate(&self.trial, &mut self.trial_gradient)
                - self.level;
            iterations += 1;
            // No progress: only rounding is left, or no state has the level. NaN if the gradient
            // vanishes.
            let nearer = reached.abs() < deviation.abs();
            if !nearer || iterations > self.iteration_limit {
                return Err(Failure::NotProjected {
                    step: step.abs(),
                    iterations,
                    deviation,
                });
            }
            (part, deviation) = (next, reached);
        }
        for (correction, &slope) in self.correction.iter_mut().zip(&self.gradient) {
            *correction = part * slope;
        }
        Ok(())
    }
}

impl<T: Real, O: ?Sized, S: Corrected<T, O>, I: FirstIntegral<T>> FixedStep<T, O>
    for ProjectedStep<S, I, T>
{
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        let start = self.steps.piece().start;
        self.level = self.integral.evaluate(start, &mut self.gradient);
        if !self.level.is_finite() {
            return Err(NonFinite::new(time, start));
        }
        self.steps.begin(system, time)
    }

    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>> {
        self.steps.make(system, time, step)?;
        let end_time = time + step;
        self.project(end_time, step)?;
        self.steps.correct(system, end_time, &self.correction)
    }

    /// Values within a step that do not follow from its ends are corrected in proportion to the
    /// time since the start of the step.
    fn piece(&self) -> Piece<'_, T> {
        let piece = self.steps.piece();
        match piece.form {
            Form::Collocation(_) => Piece {
                terms: [piece.terms[0], &self.correction],
                ..piece
            },
            _ => piece,
        }
    }

    fn advance(&mut self) {
        self.steps.advance();
    }

    fn set_start(&mut self, values: &[T]) {
        self.steps.set_start(values);
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.number(&mut self.level);
        self.steps.remember(memory);
    }
}
