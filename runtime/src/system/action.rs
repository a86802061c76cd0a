//! External actions on a motion.

use alloc::vec::Vec;

use crate::scalar::Scalar;

/// External action on a motion as a function of time and state: torques on all coordinates, or the
/// prescribed motion of some links. Functions `|time, theta, omega, torques| …` implement this
/// trait.
pub trait Action<T> {
    /// Writes the action at `time` (s) for coordinates `theta` (rad) and their velocities `omega`
    /// (rad/s).
    ///
    /// Torques are one value (N m) for each coordinate. A prescribed motion is three values for each
    /// prescribed link: angle (rad), angular velocity (rad/s) and angular acceleration (rad/s²).
    fn act(&self, time: T, theta: &[T], omega: &[T], values: &mut [T]);

    /// Returns the indices of the links whose motion is prescribed.
    #[doc(hidden)]
    fn prescribed_links(&self) -> &[usize] {
        &[]
    }
}

/// External action whose constants can be converted to any scalar type, so that ensembles can
/// integrate several trajectories at once.
///
/// # Examples
///
/// This example simulates twigs in winds of several speeds, several in one register:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::{Action, CastAction, LinkPoint, UnderTorques};
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
/// impl<T: Scalar> Action<T> for Wind<T> {
///     #[inline(always)]
///     fn act(&self, _time: T, theta: &[T], omega: &[T], torques: &mut [T]) {
///         let mut forces = [[T::from_f64(0.0); 2]];
///         self.twig.point_velocities_into(LinkPoint::End, theta, omega, &mut forces);
///         let drag = T::from_f64(0.05);
///         let forces = forces.map(|[x, y]| [drag * (self.speed - x), -(drag * y)]);
///         self.twig.point_torques_into(LinkPoint::End, theta, &forces, torques);
///     }
/// }
///
/// impl<T: Scalar> CastAction<T> for Wind<T> {
///     type Of<S: Scalar> = Wind<S>;
///
///     fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Wind<S> {
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
pub trait CastAction<T: Scalar>: Action<T> {
    /// Action with constants of the scalar type `S`.
    type Of<S: Scalar>: Action<S>;

    /// Returns the action with each constant converted by `convert`, as in
    /// [`Model::cast`](super::Model::cast).
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;
}

impl<T, F: Fn(T, &[T], &[T], &mut [T])> Action<T> for F {
    #[inline]
    fn act(&self, time: T, theta: &[T], omega: &[T], values: &mut [T]) {
        self(time, theta, omega, values);
    }
}

/// Torques that stay constant until the caller changes them, one for each coordinate.
impl<T: Scalar> Action<T> for Vec<T> {
    #[inline]
    fn act(&self, _: T, _: &[T], _: &[T], values: &mut [T]) {
        if self.len() == values.len() {
            values.copy_from_slice(self);
        } else {
            values.fill(T::from_f64(f64::NAN));
        }
    }
}

/// No external action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free;

impl<T> Action<T> for Free {
    fn act(&self, _: T, _: &[T], _: &[T], _: &mut [T]) {}
}

impl<T: Scalar> CastAction<T> for Free {
    type Of<S: Scalar> = Self;

    fn cast<S: Scalar>(&self, _: impl Fn(T) -> S) -> Self {
        Self
    }
}
