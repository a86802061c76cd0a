//! The Störmer–Verlet method, and the refusal of what it cannot do.

use alloc::vec;
use alloc::vec::Vec;

use super::explicit::{ExplicitFormula, ExplicitStep};
use super::grid::{Grid, GridSteps};
use crate::integrate::error::{InputError, Inseparable};
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::piece::Form;
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
    type Steps = GridSteps<ExplicitStep<VerletFormula, T>, T>;

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
        grid.steps(ExplicitStep::new(&start.values))
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

/// The formula of [`StoermerVerlet`].
#[derive(Clone, Copy, Debug)]
#[allow(unreachable_pub)]
pub struct VerletFormula;

/// Of the rates at the ends of a step those of the momenta count.
impl<T: Real, O: Ode<T> + ?Sized> ExplicitFormula<T, O> for VerletFormula {
    const FORM: Form = Form::Linear;

    fn make(
        own: &mut ExplicitStep<Self, T>,
        system: &mut Evaluator<'_, T, O>,
        time: T,
    ) -> Result<(), Failure<T>> {
        let (step, n) = (own.step, own.start.len() / 2);
        let half = T::from_f64(0.5) * step;
        // p at h/2 = p + h/2 F(q)
        own.stage.copy_from_slice(&own.start);
        for k in n..2 * n {
            own.stage[k] = own.start[k] + half * own.start_rates[k];
        }
        // q at h = q + h v(p at h/2)
        system.evaluate(time + half, &own.stage, &mut own.rates)?;
        for k in 0..n {
            own.stage[k] = own.start[k] + step * own.rates[k];
        }
        // p at h = p at h/2 + h/2 F(q at h)
        system.write(time + step, &own.stage, &mut own.end_rates);
        own.end.copy_from_slice(&own.stage);
        for k in n..2 * n {
            own.end[k] = own.stage[k] + half * own.end_rates[k];
        }
        if all_finite(&own.end) && all_finite(&own.end_rates) {
            return Ok(());
        }
        Err(NonFinite::new(time + step, &own.end).into())
    }
}
