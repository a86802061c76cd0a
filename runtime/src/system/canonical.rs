//! Pendulums in canonical variables.

use super::function::functions;
use super::{Free, LengthMismatch, Motion, State};
use crate::scalar::Scalar;

/// A pendulum as a first-order system in canonical variables: the state is the angles q followed by
/// their momenta p. Contains a pendulum that computes
/// [`CanonicalRates`](functions::CanonicalRates), or a reference to one.
///
/// The rates are Hamilton's equations, q' = ∂H/∂p, p' = −∂H/∂q + Q. Generalized forces Q, such as
/// friction, are part of p'; without them the motion is symplectic.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = 1, length = 1) [lower: rod(mass = 1, length = 1)],
///     emit(momenta),
/// )]
/// struct Double;
///
/// // An ensemble in the lanes of vector registers.
/// let angles = [0.1, 0.2, 0.3, 0.4];
/// let starts = angles.map(|q| State::from_positions_and_momenta(0.0, &[q, q], &[0.0; 2]).unwrap());
/// let method = Gauss::new(GaussOrder::Four, 0.01);
/// let ode = CanonicalVariables(Double::new());
/// for end in Ensemble::new().integrate_in_lanes(&method, &ode, &starts, 10.0) {
///     assert!(end?.state.values[0].abs() <= 1.0);
/// }
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
///
/// Other Hamiltonian systems are an [`Ode`](super::Ode) of coordinates and momenta, like every
/// system of equations. A point of mass m on a rod of length l has H = p²/(2ml²) + mgl(1 − cos q):
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let (mass, length) = (0.1, 0.5);
/// let point = OdeFn::new(2, |_: f64, state: &[f64], rates: &mut [f64]| {
///     rates[0] = state[1] / (mass * length * length);
///     rates[1] = -mass * 9.80665 * length * state[0].sin();
/// });
/// let start = State::from_positions_and_momenta(0.0, &[1.0], &[0.0])?;
/// let method = Gauss::new(GaussOrder::Four, 0.01);
/// let end = method.run(&point, &start, 10.0)?;
/// assert!(end.state.values[0].abs() <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type CanonicalVariables<P> = Motion<P, functions::CanonicalRates, Free>;

/// Creates the first-order system of a pendulum (or of a reference to one) in canonical variables.
#[allow(non_snake_case)]
pub const fn CanonicalVariables<P>(pendulum: P) -> CanonicalVariables<P> {
    Motion::new_of(pendulum, 0, 0, Free)
}

impl<T: Scalar> State<T> {
    /// Returns the state with coordinates `q` and momenta `p` at `time` (s).
    ///
    /// # Errors
    ///
    /// [`LengthMismatch`] unless both slices have the same length; its number of velocities is that
    /// of momenta.
    pub fn from_positions_and_momenta(time: T, q: &[T], p: &[T]) -> Result<Self, LengthMismatch> {
        Self::from_positions_and_velocities(time, q, p)
    }

    /// Returns the momenta in a state of coordinates and momenta: the second half of its components.
    pub fn momenta(&self) -> &[T] {
        self.velocities()
    }
}
