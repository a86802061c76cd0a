//! Pendulums under torques from outside.

use core::fmt;

use super::by_reference::by_reference;
use super::{Ode, Pendulum};
use crate::scalar::Scalar;

/// Equations of motion with torques that the caller hands over: wind, a hand, a motor,
/// contact. Emitted code implements it where `emit(forces)` asks for it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no torques from outside",
    note = "a model takes them with `emit(forces)` in its attribute"
)]
pub trait Forced<T: Scalar>: Pendulum<T> {
    /// Writes the angular accelerations, in rad/s², as
    /// [`Pendulum::accelerations_into`] does, with generalized torques Q (N m) on top of
    /// all others: M θ̈ + b = Q. Their power is Q·ω. All slices have length
    /// [`LINKS`](Pendulum::LINKS); for others the results are NaN.
    ///
    /// Q_i is a couple on link i. Forces on links have the torques that
    /// [`Positions`](super::Positions) tells.
    fn accelerations_under_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    );
}

by_reference! {
    impl<T: Scalar> Forced<T> for &P {
        fn accelerations_under_into(
            &self, time: T, theta: &[T], omega: &[T], torques: &[T], alpha: &mut [T]
        );
    }
}

/// A pendulum under torques as a first-order system in absolute angles: the state is
/// the angles followed by the angular velocities.
///
/// # Examples
///
/// A branch in gusts of wind, which drag at the ends of its links:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{UnderTorques, LinkPoint};
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     limb: rod(mass = 0.4, length = 0.5, friction = 0.1) [
///         twig: rod(mass = 0.1, length = 0.3, friction = 0.01) * 2
///     ],
///     emit(positions, forces),
/// )]
/// struct Branch;
///
/// let branch = Branch::new();
/// let gusts = UnderTorques::new(&branch, |time: f64, theta: &[f64], omega: &[f64], torques: &mut [f64]| {
///     let mut forces = [[0.0; 2]; 3];
///     branch.point_velocities_into(LinkPoint::End, theta, omega, &mut forces);
///     let speed = 5.0 + 3.0 * (2.0 * time).sin();
///     let drag = forces.map(|[x, y]| [0.05 * (speed - x), -0.05 * y]);
///     branch.point_torques_into(LinkPoint::End, theta, &drag, torques);
/// });
/// let method = Dop853::new(Options::with_tolerance(1e-9));
/// let end = method.integrate(&gusts, &State::at_rest(0.0, &[0.0; 3]), 10.0, |_| {
///     ControlFlow::Continue(())
/// })?;
/// assert!(end.state.values[0] > 0.1);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Copy)]
pub struct UnderTorques<P, F> {
    pendulum: P,
    torques: F,
}

impl<P, F> UnderTorques<P, F> {
    /// The pendulum, or a reference to one, under the torques that
    /// `torques(time, theta, omega, out)` writes.
    pub fn new<T>(pendulum: P, torques: F) -> Self
    where
        F: Fn(T, &[T], &[T], &mut [T]),
    {
        Self { pendulum, torques }
    }
}

impl<P: fmt::Debug, F> fmt::Debug for UnderTorques<P, F> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            pendulum,
            torques: _,
        } = self;
        formatter
            .debug_struct("UnderTorques")
            .field("pendulum", pendulum)
            .finish_non_exhaustive()
    }
}

impl<T: Scalar, P: Forced<T>, F: Fn(T, &[T], &[T], &mut [T])> Ode<T> for UnderTorques<P, F> {
    fn dimension(&self) -> usize {
        2 * P::LINKS
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        let links = P::LINKS;
        if state.len() != 2 * links || rates.len() != 2 * links {
            rates.fill(T::from_f64(f64::NAN));
            return;
        }
        let (theta, omega) = state.split_at(links);
        // The torques stand where the velocities will.
        let (torques, alpha) = rates.split_at_mut(links);
        (self.torques)(time, theta, omega, torques);
        self.pendulum
            .accelerations_under_into(time, theta, omega, torques, alpha);
        torques.copy_from_slice(omega);
    }
}
