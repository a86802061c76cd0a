//! Pendulums as first-order systems, in absolute angles and in symmetric coordinates.

use super::function::{At, Computes, functions};
use super::model::twice;
use super::ode::halves;
use super::{CastOde, Free, Model, Motion, Ode, Pendulum, Workspace};
use crate::scalar::Scalar;

/// A pendulum as a first-order system in absolute angles: the state is the angles followed by the
/// angular velocities. Contains a pendulum, or a reference to one.
#[derive(Clone, Copy, Debug)]
pub struct AbsoluteAngles<P>(pub P);

impl<T: Scalar, P: Pendulum<T>> Ode<T> for AbsoluteAngles<P> {
    fn dimension(&self) -> usize {
        2 * self.0.links()
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        second_order(self.0.links(), state, rates, |theta, omega, alpha| {
            self.0.accelerations_into(time, theta, omega, alpha);
        });
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        second_order(self.0.links(), state, rates, |theta, omega, alpha| {
            self.0
                .accelerations_with(workspace, time, theta, omega, alpha);
        });
    }
}

/// Equations of motion in symmetric coordinates: means and differences of
/// identical sibling subtrees.
///
/// There are as many coordinates as links. If all differences of a set, and their rates, are
/// exactly zero, their accelerations are exactly zero too.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no symmetric coordinates in `{T}`",
    note = "a tree with identical siblings has them with `emit(symmetric)` in its attribute"
)]
pub trait SymmetricPendulum<T: Scalar>:
    Pendulum<T> + Computes<functions::SymmetricAccelerations, T>
{
    /// Names of the symmetric coordinates, in order.
    const COORDINATE_NAMES: &'static [&'static str];

    /// Writes the second time derivatives (rad/s²) of the coordinates, for `coordinates` (rad) and
    /// `rates` (rad/s) at `time` (s).
    ///
    /// The lengths are those of [`Pendulum::accelerations_into`].
    #[inline]
    fn symmetric_accelerations_into(
        &self,
        time: T,
        coordinates: &[T],
        rates: &[T],
        accelerations: &mut [T],
    ) {
        let at = At::time(time);
        let given = [coordinates, rates];
        self.compute_with(&mut Workspace::new(), at, &given, &mut [accelerations]);
    }
}

impl<T: Scalar, P: SymmetricPendulum<T>> SymmetricPendulum<T> for &P {
    const COORDINATE_NAMES: &'static [&'static str] = P::COORDINATE_NAMES;
}

/// A pendulum as a first-order system in symmetric coordinates: the state is the coordinates
/// followed by their rates. Contains a pendulum, or a reference to one.
pub type SymmetricCoordinates<P> = Motion<P, functions::SymmetricAccelerations, Free>;

/// Creates the first-order system of a pendulum (or of a reference to one) in symmetric
/// coordinates.
#[allow(non_snake_case)]
pub const fn SymmetricCoordinates<P>(pendulum: P) -> SymmetricCoordinates<P> {
    Motion::new_of(pendulum, 0, 0, Free)
}

impl<T: Scalar, P: Pendulum<T>> CastOde<T> for AbsoluteAngles<P> {
    type Of<S: Scalar> = AbsoluteAngles<P::Of<S>>;

    const DIMENSION: Option<usize> = twice(P::KNOWN_LINKS);

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        AbsoluteAngles(self.0.cast(convert))
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(
        system: &Self::Of<S>,
        workspace: &mut Workspace<S>,
        time: S,
        state: &[S],
        rates: &mut [S],
    ) {
        let pendulum = &system.0;
        // Uses the number that the compiler knows, if it does.
        let links = pendulum.links();
        let (Some(state), Some(rates)) = (state.get(..2 * links), rates.get_mut(..2 * links))
        else {
            return;
        };
        let (theta, omega) = state.split_at(links);
        let (velocities, alpha) = rates.split_at_mut(links);
        for (rate, velocity) in velocities.iter_mut().zip(omega) {
            *rate = *velocity;
        }
        pendulum.evaluate_with(workspace, time, [theta, omega], alpha);
    }

    fn shape(&self) -> usize {
        self.0.shape()
    }
}

/// Writes the rates of a second-order system, q' = v and v' = a(q, v); NaN if a slice does not have
/// 2n numbers.
#[inline]
fn second_order<T: Scalar>(
    n: usize,
    state: &[T],
    rates: &mut [T],
    accelerations: impl FnOnce(&[T], &[T], &mut [T]),
) {
    if let Some(([positions, velocities], [position_rates, velocity_rates])) =
        halves(n, state, rates)
    {
        position_rates.copy_from_slice(velocities);
        accelerations(positions, velocities, velocity_rates);
    }
}
