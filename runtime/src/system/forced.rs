//! Pendulums under external torques.

use alloc::vec::Vec;

use super::function::{At, Computes, SliceCounts, functions};
use super::motion::{Action, CastAction, Motion, MotionFunction, Opaque};
use super::{Pendulum, Workspace};
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

/// Generalized external torques as a function of time, angles and velocities. Functions `|time,
/// theta, omega, torques| …` implement this trait.
pub trait Torques<T> {
    /// Writes the torques (N m) at `time` (s), angles `theta` (rad) and angular
    /// velocities `omega` (rad/s).
    fn torques_into(&self, time: T, theta: &[T], omega: &[T], torques: &mut [T]);
}

impl<T, F: Fn(T, &[T], &[T], &mut [T])> Torques<T> for F {
    #[inline]
    fn torques_into(&self, time: T, theta: &[T], omega: &[T], torques: &mut [T]) {
        self(time, theta, omega, torques);
    }
}

/// Torques that stay constant until the caller changes them, one for each link.
impl<T: Scalar> Torques<T> for Vec<T> {
    #[inline]
    fn torques_into(&self, _: T, _: &[T], _: &[T], torques: &mut [T]) {
        if self.len() == torques.len() {
            torques.copy_from_slice(self);
        } else {
            torques.fill(T::from_f64(f64::NAN));
        }
    }
}

/// Torques whose constants can be converted to any scalar, for ensembles in lanes.
///
/// # Examples
///
/// This example simulates twigs in winds of several speeds, several in one register:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{LaneTorques, LinkPoint, Torques, UnderTorques};
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     twig: rod(mass = 0.1, length = 0.3, friction = 0.01),
///     emit(positions, forces),
/// )]
/// struct Twig;
///
/// /// It drags at the ends of links.
/// struct Wind<T> {
///     twig: Twig<T>,
///     speed: T,
/// }
///
/// impl<T: Scalar> Torques<T> for Wind<T> {
///     #[inline(always)]
///     fn torques_into(&self, _time: T, theta: &[T], omega: &[T], torques: &mut [T]) {
///         let mut forces = [[T::from_f64(0.0); 2]];
///         self.twig.point_velocities_into(LinkPoint::End, theta, omega, &mut forces);
///         let drag = T::from_f64(0.05);
///         let forces = forces.map(|[x, y]| [drag * (self.speed - x), -(drag * y)]);
///         self.twig.point_torques_into(LinkPoint::End, theta, &forces, torques);
///     }
/// }
///
/// impl<T: Scalar> LaneTorques<T> for Wind<T> {
///     type Of<S: Scalar> = Wind<S>;
///
///     fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Wind<S> {
///         Wind { twig: self.twig.cast(&convert), speed: convert(self.speed) }
///     }
/// }
///
/// let calm = State::at_rest(0.0, &[0.0]);
/// let winds: Vec<_> = (0..20)
///     .map(|i| Wind { twig: Twig::new(), speed: 0.5 * f64::from(i) })
///     .map(|wind| (UnderTorques::of(Twig::new(), wind), calm.clone()))
///     .collect();
/// let method = Dop853::new(Options::with_tolerance(1e-9));
/// let ends = Ensemble::new().integrate_models_in_lanes(&method, &winds, 20.0);
/// let angles: Vec<f64> = ends.into_iter().map(|end| Ok(end?.state.values[0])).collect::<Result<_, IntegrationError<f64>>>()?;
/// assert!(angles[0] == 0.0 && angles.is_sorted());
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
pub trait LaneTorques<T: Scalar>: Torques<T> {
    /// The type of these torques with constants of the scalar type `S`.
    type Of<S: Scalar>: Torques<S>;

    /// Returns the torques with each constant converted by `convert`, as in
    /// [`Model::cast`](super::Model::cast).
    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;
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
pub type UnderTorques<P, F> = Motion<P, functions::AccelerationsUnderTorques, ByTorques<F>>;

/// Torques from outside.
#[derive(Clone, Copy, Debug)]
pub struct ByTorques<A>(pub(super) Opaque<A>);

impl<P, F> UnderTorques<P, F> {
    /// Creates the system of a pendulum (or of a reference to one) under the torques that
    /// `torques(time, theta, omega, out)` writes.
    pub fn new<T>(pendulum: P, torques: F) -> Self
    where
        F: Fn(T, &[T], &[T], &mut [T]),
    {
        Self::of(pendulum, torques)
    }

    /// Creates the system of a pendulum (or of a reference to one) under torques of a type that
    /// implements [`Torques`], such as a vector of constant torques.
    pub fn of(pendulum: P, torques: F) -> Self {
        Self::new_of(pendulum, 0, 0, ByTorques(Opaque(torques)))
    }
}

impl<P, F, A> Motion<P, F, ByTorques<A>> {
    /// Returns the torques.
    pub fn torques(&self) -> &A {
        &self.action.0.0
    }

    /// Returns the torques, so that they can be changed, for example between two frames of
    /// [`Frames`](crate::integrate::Frames).
    pub fn torques_mut(&mut self) -> &mut A {
        &mut self.action.0.0
    }
}

impl<P: Computes<Self, T>, T: Scalar> MotionFunction<P, T>
    for functions::AccelerationsUnderTorques
{
    const COORDINATES: Option<usize> = P::KNOWN_LINKS;
}

impl<T: Scalar, A: Torques<T>> Action<T> for ByTorques<A> {
    #[inline(always)]
    fn rates<F: SliceCounts, M: Computes<F, T>>(
        motion: &Motion<M, F, Self>,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [angles, velocities]: [&[T]; 2],
        [first, second]: [&mut [T]; 2],
    ) {
        let torques = &motion.action.0.0;
        // The torques use the memory of the velocities until these are written.
        torques.torques_into(time, angles, velocities, first);
        motion.accelerate(workspace, time, [angles, velocities], first, second);
        first.copy_from_slice(velocities);
    }
}

impl<T: Scalar, A: LaneTorques<T>> CastAction<T> for ByTorques<A> {
    type On<S: Scalar> = ByTorques<A::Of<S>>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        ByTorques(Opaque(self.0.0.on_scalar(convert)))
    }
}
