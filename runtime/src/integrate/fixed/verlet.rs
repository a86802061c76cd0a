//! The Störmer–Verlet method, and the refusal of what it cannot do.

use alloc::vec;
use alloc::vec::Vec;

use super::grid::{FixedStep, Grid, GridSteps};
use crate::integrate::error::{InputError, Inseparable};
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::{Form, Piece};
use crate::integrate::request::all_finite;
use crate::integrate::steps::Failure;
use crate::scalar::{Real, Scalar};
use crate::system::{Canonical, CanonicalVariables, Ode, State};

/// The Störmer–Verlet method (leapfrog, kick-drift-kick) with steps of one
/// length: explicit, symplectic and symmetric, of order 2, **for H = T(p) + U(q)
/// alone**.
///
/// The kinetic energy of links that hang from other links depends on the angles:
/// a run with such a tree is refused with [`InputError::NotSeparable`] before
/// anything is computed, and so is one with friction. What is left are single
/// links, and trees whose links all hang where the pivot of the root is. All
/// others have [`Gauss`](super::Gauss), which needs no such form.
///
/// Refused is what shows itself: rates at the start and at two other states are
/// compared. A step takes two evaluations; values inside a step are on the
/// straight line between its ends, whose error is of the method's order. Memory:
/// 6 vectors of the state's length; steps allocate nothing.
///
/// Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd
/// edition, Springer 2006, section I.1.4 and theorem VI.3.4.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::integrate::{InputError, Inseparable, StoermerVerlet};
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665, rod: rod(mass = 1, length = 1), emit(energies, momenta)
/// )]
/// struct Simple;
///
/// let (simple, method) = (Simple::new(), StoermerVerlet::new(1e-3));
/// let start = State::from_positions_and_momenta(0.0, &[2.0], &[0.0])?;
/// let ode = CanonicalVariables(&simple);
/// let end = method.integrate(&ode, &start, 100.0, |_| ControlFlow::Continue(()))?.state;
/// let energy = |s: &State<f64>| {
///     let theta = [s.positions()[0]];
///     simple.kinetic_energy(&theta, &simple.velocities(&theta, &[s.momenta()[0]]))
///         + simple.potential_energy(&theta)
/// };
/// assert!((energy(&end) - energy(&start)).abs() < 1e-5);
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = 1, length = 1) [lower: rod(mass = 1, length = 1)],
///     emit(momenta),
/// )]
/// struct Double;
///
/// let double = Double::new();
/// let start = State::from_positions_and_momenta(0.0, &[2.0, 1.0], &[0.0, 0.0])?;
/// let refused = method.integrate(&CanonicalVariables(&double), &start, 1.0, |_| {
///     ControlFlow::Continue(())
/// });
/// let Err(IntegrationError::Input(InputError::NotSeparable { rate, .. })) = refused else {
///     panic!("the kinetic energy of a double pendulum depends on its angles");
/// };
/// assert_eq!(rate, Inseparable::Velocity);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StoermerVerlet<T> {
    /// Length of the steps, positive whatever the direction. The last one is
    /// shorter where the span is no multiple of it.
    pub step: T,
    /// Number of steps after which a run ends with an error.
    pub step_limit: u64,
}

impl<T: Real> StoermerVerlet<T> {
    /// The method with steps of length `step`, without a limit on their
    /// number.
    pub fn new(step: T) -> Self {
        Self {
            step,
            step_limit: u64::MAX,
        }
    }
}

impl<T: Real, C: Canonical<T>> Integrator<T, CanonicalVariables<C>> for StoermerVerlet<T> {
    type Steps = GridSteps<VerletStep<T>, T>;

    fn steps(
        &self,
        ode: &CanonicalVariables<C>,
        start: &State<T>,
    ) -> Result<Self::Steps, InputError<T>> {
        check_separable(ode, start)?;
        let grid = Grid {
            step: self.step,
            halvings: 0,
            step_limit: self.step_limit,
        };
        grid.steps(VerletStep::new(&start.values))
    }
}

/// Passes equations whose velocities do not change with the coordinates, nor rates of
/// momenta with the momenta.
fn check_separable<T: Real, C: Canonical<T>>(
    ode: &CanonicalVariables<C>,
    start: &State<T>,
) -> Result<(), InputError<T>> {
    let n = start.values.len() / 2;
    let largest = |values: &[T]| values.iter().fold(T::ZERO, |a, b| a.max(b.abs()));
    let momentum = largest(start.momenta());
    let momentum = if momentum > T::ZERO { momentum } else { T::ONE };
    // Multiples of the golden ratio: no two displacements are alike, whatever
    // symmetry the system has.
    let spread = |k: usize| T::from_f64(0.1 + (0.618_033_988_749_895 * (k + 1) as f64) % 1.0);
    let state = |moved_q: bool, moved_p: bool| -> Vec<T> {
        let values = start.values.iter().enumerate();
        let values = values.map(|(k, &value)| match (k < n, moved_q, moved_p) {
            (true, true, _) => value + spread(k),
            (true, false, _) => value,
            (false, _, false) => momentum * spread(k),
            (false, _, true) => -(momentum * spread(2 * n - k)),
        });
        values.collect()
    };
    let rates = |state: Vec<T>| {
        let mut rates = vec![T::ZERO; 2 * n];
        ode.rates(start.time, &state, &mut rates);
        rates
    };
    let reference = rates(state(false, false));
    let tolerance = Scalar::sqrt(T::EPSILON);
    for (rate, other, range) in [
        (Inseparable::Velocity, rates(state(true, false)), 0..n),
        (Inseparable::Force, rates(state(false, true)), n..2 * n),
    ] {
        let size = largest(&reference[range.clone()]).max(largest(&other[range.clone()]));
        for index in range {
            let change = (other[index] - reference[index]).abs() / size;
            // A size of zero, and rates that are not finite, are left to the run.
            if change > tolerance {
                return Err(InputError::NotSeparable {
                    coordinate: index % n,
                    rate,
                    change,
                });
            }
        }
    }
    Ok(())
}

/// The vectors that a step works on.
#[derive(Clone, Debug)]
#[allow(unreachable_pub)]
pub struct VerletStep<T> {
    start: Vec<T>,
    end: Vec<T>,
    /// Coordinates with the momenta of the middle of the step.
    stage: Vec<T>,
    rates: Vec<T>,
    /// Rates at the start of the step, of which those of the momenta count.
    start_rates: Vec<T>,
    end_rates: Vec<T>,
    step: T,
}

impl<T: Real> VerletStep<T> {
    fn new(start: &[T]) -> Self {
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

impl<T: Real, O: Ode<T> + ?Sized> FixedStep<T, O> for VerletStep<T> {
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
        let n = self.start.len() / 2;
        let half = T::from_f64(0.5) * step;
        // p at h/2 = p + h/2 F(q)
        self.stage.copy_from_slice(&self.start);
        for k in n..2 * n {
            self.stage[k] = self.start[k] + half * self.start_rates[k];
        }
        // q at h = q + h v(p at h/2)
        system.evaluate(time + half, &self.stage, &mut self.rates)?;
        for k in 0..n {
            self.stage[k] = self.start[k] + step * self.rates[k];
        }
        // p at h = p at h/2 + h/2 F(q at h)
        system.write(time + step, &self.stage, &mut self.end_rates);
        self.end.copy_from_slice(&self.stage);
        for k in n..2 * n {
            self.end[k] = self.stage[k] + half * self.end_rates[k];
        }
        if all_finite(&self.end) && all_finite(&self.end_rates) {
            return Ok(());
        }
        Err(NonFinite::new(time + step, &self.end).into())
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: Form::Linear,
            start: &self.start,
            end: &self.end,
            terms: [&[]; 2],
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
}
