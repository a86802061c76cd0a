//! Quantities that a motion conserves.

use super::derivatives::{Slopes, gradient};
use super::function::{Computes, functions};
use super::ode::halves;
use super::{Energy, Model, Workspace};
use crate::scalar::Scalar;

/// A function of the state that is constant along every motion, with its gradient.
/// [`Projected`](crate::integrate::Projected) keeps the states of an integration at its initial
/// value.
///
/// Any function `(state, gradient) -> value` implements this trait.
pub trait FirstIntegral<T> {
    /// Returns the value at `state`, and writes its derivatives by the components of the state to
    /// `gradient`, which has the same length.
    fn evaluate(&self, state: &[T], gradient: &mut [T]) -> T;
}

impl<T, F: Fn(&[T], &mut [T]) -> T> FirstIntegral<T> for F {
    fn evaluate(&self, state: &[T], gradient: &mut [T]) -> T {
        self(state, gradient)
    }
}

/// The energy of a pendulum in canonical variables, H = K + U, with the gradient (−p', q') of
/// Hamilton's equations. Contains a pendulum, or a reference to one.
///
/// It is valid for conservative pendulums only: if p' includes friction or a drive, H is not
/// conserved, and the vector written is not its gradient.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::integrate::Projected;
/// use branched_pendulum::system::CanonicalEnergy;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = 1, length = 1) [lower: rod(mass = 1, length = 1)],
///     emit(energies, momenta),
/// )]
/// struct Double;
///
/// let double = Double::new();
/// let energy = CanonicalEnergy(&double);
/// let start = State::from_positions_and_momenta(0.0, &[0.8, 0.2], &[0.0, 0.0])?;
/// let level: f64 = energy.evaluate(&start.values, &mut [0.0; 4]);
/// let method = Projected::new(Gauss::new(GaussOrder::Two, 0.05), energy);
/// let ode = CanonicalVariables(&double);
/// let end = method.run(&ode, &start, 10.0)?.state;
/// assert!((energy.evaluate(&end.values, &mut [0.0; 4]) - level).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CanonicalEnergy<P>(pub P);

impl<T, P> FirstIntegral<T> for CanonicalEnergy<P>
where
    T: Scalar,
    P: Energy<T> + Computes<functions::CanonicalRates, T>,
{
    fn evaluate(&self, state: &[T], gradient: &mut [T]) -> T {
        let n = self.0.links();
        let Some(([q, p], [slopes, velocities])) = halves(n, state, gradient) else {
            return T::from_f64(f64::NAN);
        };
        let time = T::from_f64(0.0);
        self.0.canonical_rates_into(time, q, p, velocities, slopes);
        for slope in slopes {
            *slope = -*slope;
        }
        self.0.kinetic_energy_of(q, velocities) + self.0.potential_energy_of(q)
    }
}

/// The energy of a pendulum in absolute angles, K + U, with the gradient computed by dual numbers.
///
/// It is valid for conservative pendulums only, like [`CanonicalEnergy`]. A gradient takes about
/// n/8 evaluations of the energy for n links, and allocates.
///
/// # Examples
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::integrate::Projected;
/// use branched_pendulum::system::TotalEnergy;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = 1, length = 1) [lower: rod(mass = 1, length = 1)],
///     emit(energies),
/// )]
/// struct Double;
///
/// let energy = TotalEnergy::new(Double::new());
/// let start = State::at_rest(0.0, &[0.8, 0.2]);
/// let level: f64 = energy.evaluate(&start.values, &mut [0.0; 4]);
/// let method = Projected::new(Rk4::new(0.01), energy.clone());
/// let ode = AbsoluteAngles(Double::new());
/// let end = method.run(&ode, &start, 10.0)?.state;
/// assert!((energy.evaluate(&end.values, &mut [0.0; 4]) - level).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TotalEnergy<P, D> {
    pendulum: P,
    with_slopes: D,
}

impl<P> TotalEnergy<P, ()> {
    /// Returns the energy of a pendulum (or of a reference to one) as a first integral.
    #[allow(clippy::new_ret_no_self)]
    pub fn new<T: Scalar>(pendulum: P) -> TotalEnergy<P, P::Of<Slopes<T>>>
    where
        P: Model<T>,
    {
        let with_slopes = pendulum.cast(Slopes::<T>::constant);
        TotalEnergy {
            pendulum,
            with_slopes,
        }
    }
}

impl<T: Scalar, P: Energy<T>, D: Energy<Slopes<T>>> FirstIntegral<T> for TotalEnergy<P, D> {
    fn evaluate(&self, state: &[T], slopes: &mut [T]) -> T {
        let n = self.pendulum.links();
        if [state.len(), slopes.len()] != [2 * n; 2] {
            slopes.fill(T::from_f64(f64::NAN));
            return T::from_f64(f64::NAN);
        }
        let mut workspace = Workspace::new();
        gradient(state, slopes, |state| {
            let (theta, omega) = state.split_at(n);
            let kinetic = self
                .with_slopes
                .kinetic_energy_with(&mut workspace, theta, omega);
            kinetic
                + self
                    .with_slopes
                    .potential_energy_with(&mut workspace, theta)
        });
        let (theta, omega) = state.split_at(n);
        self.pendulum.energy_of(theta, omega)
    }
}
