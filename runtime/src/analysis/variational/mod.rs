//! Variational equations: how small deviations from a motion grow.
//!
//! With y' = f(t, y) a small deviation v obeys v' = ∂f/∂y v. A [`Linearised`] system gives both;
//! [`Variational`] is the system of the motion and any number of deviations, which every method
//! integrates with its error control. [`flow_jacobian`] is the derivative of the end with respect
//! to the start, [`trusted_until`] the time up to which a given error stays small, and [`Lyapunov`]
//! computes mean rates of growth: of all deviations or, if [`Copies`] move in phase, separately of
//! in-phase deviations and of differences between copies.
//!
//! The derivative comes from numbers that carry one, exact to rounding
//! ([`linearised`] for models, [`ByTangents`] for other equations that are generic
//! over the scalar), or from a function of the caller ([`WithDerivative`]).
//!
//! # Example
//!
//! Growth of a deviation as a pendulum leaves the top, and the time for which
//! rounding lets one say where it is:
//!
//! ```
//! use branched_pendulum::analysis::variational::{WithDerivative, flow_jacobian, trusted_until};
//! use branched_pendulum::prelude::*;
//! use branched_pendulum::system::OdeFn;
//!
//! let pendulum = WithDerivative::new(
//!     OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
//!         rates[0] = y[1];
//!         rates[1] = -y[0].sin();
//!     }),
//!     |_time: f64, y: &[f64], v: &[f64], out: &mut [f64]| {
//!         out[0] = v[1];
//!         out[1] = -y[0].cos() * v[0];
//!     },
//! );
//! let top = State::at_rest(0.0, &[core::f64::consts::PI]);
//! let method = Dop853::new(Options::with_tolerance(1e-12));
//! let (_, columns) = flow_jacobian(&method, &pendulum, &top, 5.0)?;
//! assert!((columns[0] - 5.0_f64.cosh()).abs() < 1e-9);
//! // One rounding is a thousandth of a radian after some thirty seconds.
//! let until = trusted_until(&method, &pendulum, &top, 100.0, 1e-16, 1e-3)?;
//! assert!(until.is_some_and(|time| (25.0..35.0).contains(&time)));
//! # Ok::<(), IntegrationError<f64>>(())
//! ```

mod copies;
mod deviations;
mod error;
mod lyapunov;
mod system;

use core::ops::ControlFlow;

use crate::integrate::{InputError, IntegrationError, Integrator};
use crate::scalar::Real;
use crate::system::{Ode, State};

pub use self::copies::Copies;
pub use self::error::LyapunovError;
pub use self::lyapunov::{Lyapunov, LyapunovSpectrum};
pub use self::system::{ByTangents, Linearised, Tangent, Variational, WithDerivative, linearised};

/// Returns the start state followed by unit deviations along each of its components.
fn with_unit_deviations<T: Real>(start: &State<T>) -> State<T> {
    let n = start.values.len();
    let mut values = start.values.clone();
    for direction in 0..n {
        values.extend((0..n).map(|i| if i == direction { T::ONE } else { T::ZERO }));
    }
    State::new(start.time, values)
}

fn check_dimension<T: Real, L: Ode<T>>(
    system: &L,
    start: &State<T>,
) -> Result<(), IntegrationError<T>> {
    let (expected, found) = (system.dimension(), start.values.len());
    if expected == found {
        return Ok(());
    }
    Err(InputError::Dimension { expected, found }.into())
}

/// Returns the state at `end` (s) and its derivative with respect to the state at the start. The
/// derivative is stored by columns: column j, the n numbers from index n·j on, is the derivative of
/// the end by component j of the start.
///
/// The cost is that of n deviations integrated with the motion. For a conservative system in
/// canonical variables the matrix is symplectic.
///
/// # Errors
///
/// As [`Integrator::integrate`].
pub fn flow_jacobian<T, L, M>(
    method: &M,
    system: &L,
    start: &State<T>,
    end: T,
) -> Result<(State<T>, Vec<T>), IntegrationError<T>>
where
    T: Real,
    L: Linearised<T>,
    M: for<'a> Integrator<T, Variational<'a, L>>,
{
    check_dimension(system, start)?;
    let n = start.values.len();
    let all = Variational::new(system, n);
    let start = with_unit_deviations(start);
    let mut solution = method.run(&all, &start, end)?;
    let columns = solution.state.values.split_off(n);
    Ok((solution.state, columns))
}

/// Returns the time (s) up to which an error of size `error` at the start stays below `allowed`,
/// both in the Euclidean norm of the state and in the linear approximation; `None` if it does so up
/// to `end` (s).
///
/// This is the horizon of a chaotic motion: for an `error` of one rounding, it is the time after
/// which no digits are left, for any method and tolerance. The growth is the Frobenius
/// norm of the flow's derivative, which exceeds that of the worst direction by the factor √n at
/// most; the time is the end of a step.
///
/// # Errors
///
/// As [`Integrator::integrate`].
pub fn trusted_until<T, L, M>(
    method: &M,
    system: &L,
    start: &State<T>,
    end: T,
    error: T,
    allowed: T,
) -> Result<Option<T>, IntegrationError<T>>
where
    T: Real,
    L: Linearised<T>,
    M: for<'a> Integrator<T, Variational<'a, L>>,
{
    check_dimension(system, start)?;
    let n = start.values.len();
    let all = Variational::new(system, n);
    let mut horizon = None;
    method.integrate(&all, &with_unit_deviations(start), end, |step| {
        let deviations = &step.end()[n..];
        let squares = deviations.iter().fold(T::ZERO, |sum, &v| sum + v * v);
        if error * squares.sqrt() < allowed {
            return ControlFlow::Continue(());
        }
        horizon = Some(step.start_time());
        ControlFlow::Break(())
    })?;
    Ok(horizon)
}
