//! Pendulums under external torques.

use super::function::{At, Computes, functions};
use super::{Motion, Pendulum, Workspace};
use crate::scalar::Scalar;

/// Equations of motion with torques that the caller passes: wind, a hand, a motor, contact. Models
/// have them with `emit(forces)`; every type that computes
/// [`AccelerationsUnderTorques`](functions::AccelerationsUnderTorques) implements this trait.
#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no torques from outside",
    note = "a model takes them with `emit(forces)` in its attribute"
)]
pub trait Forced<T: Scalar>:
    Pendulum<T> + Computes<functions::AccelerationsUnderTorques, T>
{
    /// Writes the angular accelerations (rad/s²) like [`Pendulum::accelerations_into`], with
    /// generalized torques Q (N m) in addition to all others: M θ̈ + b = Q. Their power is Q·ω. All
    /// slices have one number for each [link](super::Model::links); for other lengths the results
    /// are NaN.
    ///
    /// Q_i is a couple on link i. For the torques of forces on links, see
    /// [`Positions`](super::Positions). If a link represents several links of a whole tree, its
    /// torque is the sum of the torques on these:
    /// [`WholeTree::torques`](super::WholeTree::torques).
    #[inline]
    fn accelerations_under_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    ) {
        let workspace = &mut Workspace::new();
        self.accelerations_under_with(workspace, time, theta, omega, torques, alpha);
    }

    /// Writes the same accelerations, using memory that the caller keeps, as
    /// [`Pendulum::accelerations_with`] does.
    #[inline]
    fn accelerations_under_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    ) {
        let given = [theta, omega, torques];
        Computes::<functions::AccelerationsUnderTorques, T>::compute_with(
            self,
            workspace,
            At::time(time),
            &given,
            &mut [alpha],
        );
    }

    /// Writes the generalized torques Q (N m) that give the links the angular accelerations `alpha`
    /// (rad/s²): Q = M θ̈ + b, the inverse of
    /// [`accelerations_under_into`](Self::accelerations_under_into). All slices have one number for
    /// each [link](super::Model::links); for other lengths the results are NaN. Compiled models
    /// have this function if the description has `emit(inverse_dynamics)`.
    #[inline]
    fn inverse_dynamics_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &[T],
        torques: &mut [T],
    ) where
        Self: Computes<functions::InverseDynamics, T>,
    {
        let workspace = &mut Workspace::new();
        self.inverse_dynamics_with(workspace, time, theta, omega, alpha, torques);
    }

    /// Writes the same torques, with a workspace that the caller keeps, as
    /// [`Pendulum::accelerations_with`] does.
    #[inline]
    fn inverse_dynamics_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &[T],
        torques: &mut [T],
    ) where
        Self: Computes<functions::InverseDynamics, T>,
    {
        let given = [theta, omega, alpha];
        Computes::<functions::InverseDynamics, T>::compute_with(
            self,
            workspace,
            At::time(time),
            &given,
            &mut [torques],
        );
    }
}

impl<T: Scalar, P> Forced<T> for P where
    P: Pendulum<T> + Computes<functions::AccelerationsUnderTorques, T>
{
}

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
