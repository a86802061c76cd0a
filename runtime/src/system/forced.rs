//! Pendulums under torques from outside.

use alloc::vec::Vec;

use super::function::{At, Computes, compute_in, functions};
use super::second_order::{CastSecondOrder, HandedOver, SecondOrder, SecondOrderOde};
use super::{Pendulum, Workspace};
use crate::scalar::Scalar;

/// Equations of motion with torques that the caller hands over: wind, a hand, a motor,
/// contact. Models have them with `emit(forces)`; what computes
/// [`AccelerationsUnderTorques`](functions::AccelerationsUnderTorques) implements this.
#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no torques from outside",
    note = "a model takes them with `emit(forces)` in its attribute"
)]
pub trait Forced<T: Scalar>:
    Pendulum<T> + Computes<functions::AccelerationsUnderTorques, T>
{
    /// Writes the angular accelerations, in rad/s², as
    /// [`Pendulum::accelerations_into`] does, with
    /// generalized torques Q (N m) on top of all others: M θ̈ + b = Q. Their power is Q·ω. All
    /// slices have one number for each [link](super::Model::links); for others the results are NaN.
    ///
    /// Q_i is a couple on link i. Forces on links have the torques that
    /// [`Positions`](super::Positions) tells. On a link that stands for several of a
    /// whole tree it is the sum of the torques on these:
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

    /// Writes the same accelerations, in memory that the caller keeps, as
    /// [`Pendulum::accelerations_with`].
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
        self.compute_with(workspace, At::time(time), &given, &mut [alpha]);
    }
}

impl<T: Scalar, P> Forced<T> for P where
    P: Pendulum<T> + Computes<functions::AccelerationsUnderTorques, T>
{
}

/// Generalized torques from outside, as a function of time, angles and velocities.
/// Functions `|time, theta, omega, torques| …` are some.
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

/// Torques that stay as they are until the caller changes them, one for each link.
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

/// Torques whose constants can be taken to any scalar, for ensembles in lanes.
///
/// # Examples
///
/// Twigs in winds of many speeds, several in a register:
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
    /// These torques on other scalars.
    type Of<S: Scalar>: Torques<S>;

    /// Takes every constant through `convert`, as
    /// [`Model::cast`](super::Model::cast).
    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;
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
/// let end = method.run(&gusts, &State::at_rest(0.0, &[0.0; 3]), 10.0)?;
/// assert!(end.state.values[0] > 0.1);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
pub type UnderTorques<P, F> = SecondOrderOde<Pushed<P, F>>;

/// A pendulum and the torques on it: [`UnderTorques`].
#[derive(Clone, Copy, Debug)]
pub struct Pushed<P, F> {
    pendulum: P,
    torques: HandedOver<F>,
}

impl<P, F> SecondOrderOde<Pushed<P, F>> {
    /// The pendulum, or a reference to one, under the torques that
    /// `torques(time, theta, omega, out)` writes.
    pub fn new<T>(pendulum: P, torques: F) -> Self
    where
        F: Fn(T, &[T], &[T], &mut [T]),
    {
        Self::of(pendulum, torques)
    }

    /// The pendulum, or a reference to one, under [`Torques`] of a type of their own, or
    /// under a vector of those that stay as they are.
    pub fn of(pendulum: P, torques: F) -> Self {
        SecondOrderOde(Pushed {
            pendulum,
            torques: HandedOver(torques),
        })
    }

    /// The torques.
    pub fn torques(&self) -> &F {
        &self.0.torques.0
    }

    /// The torques, to change them: a vector between two frames of
    /// [`Frames`](crate::integrate::Frames), for example.
    pub fn torques_mut(&mut self) -> &mut F {
        &mut self.0.torques.0
    }
}

impl<T: Scalar, P, F> SecondOrder<T> for Pushed<P, F>
where
    P: Computes<functions::AccelerationsUnderTorques, T>,
    F: Torques<T>,
{
    fn coordinates(&self) -> usize {
        self.pendulum.links()
    }

    #[inline(always)]
    fn rates(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        [theta, omega]: [&[T]; 2],
        [velocities, alpha]: [&mut [T]; 2],
    ) {
        // Torques stand where the velocities will.
        self.torques.0.torques_into(time, theta, omega, velocities);
        let given = [theta, omega, velocities];
        compute_in(
            &self.pendulum,
            workspace,
            At::time(time),
            &given,
            &mut [alpha],
        );
        velocities.copy_from_slice(omega);
    }
}

impl<T: Scalar, P, F> CastSecondOrder<T> for Pushed<P, F>
where
    P: Computes<functions::AccelerationsUnderTorques, T>,
    F: LaneTorques<T>,
{
    type On<S: Scalar> = Pushed<P::On<S>, F::Of<S>>;

    const COORDINATES: Option<usize> = P::KNOWN_LINKS;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S> {
        Pushed {
            pendulum: self.pendulum.on(&convert),
            torques: HandedOver(self.torques.0.on_scalar(&convert)),
        }
    }

    fn shape(&self) -> usize {
        self.pendulum.shape()
    }
}
