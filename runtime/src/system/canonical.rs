//! Hamiltonian systems in canonical variables.

use super::by_reference::by_reference;
use super::ode::halves;
use super::{CastOde, LengthMismatch, Model, Ode, State};
use crate::scalar::Scalar;

/// Hamilton's equations, q' = ∂H/∂p, p' = −∂H/∂q + Q, in canonical variables.
///
/// For a pendulum with mass matrix M the velocities are q' = M⁻¹p and the rates of the momenta
/// ∂L/∂q at these velocities: no derivative of M⁻¹ is needed. Generalised forces Q, such as
/// friction, are part of p'; without them the motion is symplectic.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
///
/// /// A point of mass m on a rod of length l: H = p²/(2ml²) + mgl(1 − cos q).
/// struct Point { mass: f64, length: f64 }
///
/// impl Canonical<f64> for Point {
///     fn degrees_of_freedom(&self) -> usize {
///         1
///     }
///     fn canonical_rates(
///         &self, _time: f64, q: &[f64], p: &[f64], q_rates: &mut [f64], p_rates: &mut [f64],
///     ) {
///         q_rates[0] = p[0] / (self.mass * self.length * self.length);
///         p_rates[0] = -self.mass * 9.80665 * self.length * q[0].sin();
///     }
/// }
///
/// let point = Point { mass: 0.1, length: 0.5 };
/// let start = State::from_positions_and_momenta(0.0, &[1.0], &[0.0])?;
/// let method = Gauss::new(GaussOrder::Four, 0.01);
/// let end = method.run(&CanonicalVariables(&point), &start, 10.0)?;
/// assert!(end.state.values[0].abs() <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no canonical equations in `{T}`",
    note = "a model has them with `emit(momenta)` in its attribute"
)]
pub trait Canonical<T> {
    /// Returns the number of coordinates, which equals the number of momenta.
    fn degrees_of_freedom(&self) -> usize;

    /// Writes the rates of the coordinates `q` (rad) and of the momenta `p` (kg m²/s) at `time`
    /// (s). All four slices have length [`degrees_of_freedom`](Self::degrees_of_freedom).
    ///
    /// Writes NaN where the rates are undefined.
    fn canonical_rates(&self, time: T, q: &[T], p: &[T], q_rates: &mut [T], p_rates: &mut [T]);
}

by_reference! {
    impl<T> Canonical<T> for &P {
        fn degrees_of_freedom(&self) -> usize;
        fn canonical_rates(&self, time: T, q: &[T], p: &[T], q_rates: &mut [T], p_rates: &mut [T]);
    }
}

/// A [`Canonical`] system as a first-order system: the state is the coordinates followed by the
/// momenta. Contains the system, or a reference to it.
#[derive(Clone, Copy, Debug)]
pub struct CanonicalVariables<C>(pub C);

impl<T: Scalar, S: Scalar, C> CastOde<T, S> for CanonicalVariables<C>
where
    C: Model<T> + Canonical<T>,
    C::Of<S>: Canonical<S>,
{
    type Of = CanonicalVariables<C::Of<S>>;

    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of {
        CanonicalVariables(self.0.cast(convert))
    }
}

impl<T: Scalar, C: Canonical<T>> Ode<T> for CanonicalVariables<C> {
    fn dimension(&self) -> usize {
        2 * self.0.degrees_of_freedom()
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let n = self.0.degrees_of_freedom();
        if let Some(([q, p], [q_rates, p_rates])) = halves(n, state, rates) {
            self.0.canonical_rates(time, q, p, q_rates, p_rates);
        }
    }
}

impl<T: Scalar> State<T> {
    /// Returns the state of a [`Canonical`] system with coordinates `q` and momenta `p` at `time`
    /// (s).
    ///
    /// # Errors
    ///
    /// [`LengthMismatch`] unless both slices have the same length; its number of velocities is that
    /// of momenta.
    pub fn from_positions_and_momenta(time: T, q: &[T], p: &[T]) -> Result<Self, LengthMismatch> {
        Self::from_positions_and_velocities(time, q, p)
    }

    /// Returns the momenta in a state of a [`Canonical`] system: the second half of its components.
    pub fn momenta(&self) -> &[T] {
        self.velocities()
    }
}
