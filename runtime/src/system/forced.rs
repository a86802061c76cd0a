//! Pendulums under external torques.

use super::Motion;
use super::function::functions;

/// A pendulum under torques as a first-order system in absolute angles: the state is the angles
/// followed by the angular velocities.
///
/// # Examples
///
/// This branch is in gusts of wind, whose drag acts at the ends of its links:
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
/// let end = method.run(&gusts, &State::at_rest(0.0, &[0.0; 3]), 10.0)?;
/// assert!(end.state.values[0] > 0.1);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
pub type UnderTorques<P, A> = Motion<P, functions::AccelerationsUnderTorques, A>;

impl<P, A> UnderTorques<P, A> {
    /// Creates the system of a pendulum (or of a reference to one) under the torques that
    /// `torques(time, theta, omega, out)` writes.
    pub fn new<T>(pendulum: P, torques: A) -> Self
    where
        A: Fn(T, &[T], &[T], &mut [T]),
    {
        Self::of(pendulum, torques)
    }

    /// Creates the system of a pendulum (or of a reference to one) under torques of a type that
    /// implements [`Action`](super::Action), such as a vector of constant torques.
    pub fn of(pendulum: P, torques: A) -> Self {
        Self::new_of(pendulum, 0, 0, torques)
    }

    /// Returns the torques.
    pub fn torques(&self) -> &A {
        &self.action
    }

    /// Returns the torques, so that they can be changed, for example between two frames of
    /// [`Frames`](crate::integrate::Frames).
    pub fn torques_mut(&mut self) -> &mut A {
        &mut self.action
    }
}
