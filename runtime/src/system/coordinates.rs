//! Pendulums as first-order systems.

use super::cast::put;
use super::ode::halves;
use super::{Cast, CastOde, LaneOde, Ode, Pendulum, SymmetricPendulum, Workspace};
use crate::scalar::{Scalar, at};

/// A pendulum as a first-order system in absolute angles: the state is the
/// angles followed by the angular velocities. Holds a pendulum, or a reference to
/// one.
#[derive(Clone, Copy, Debug)]
pub struct AbsoluteAngles<P>(pub P);

impl<T: Scalar, P: Pendulum<T>> Ode<T> for AbsoluteAngles<P> {
    fn dimension(&self) -> usize {
        2 * P::LINKS
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        second_order(P::LINKS, state, rates, |theta, omega, alpha| {
            self.0.accelerations_into(time, theta, omega, alpha);
        });
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        second_order(P::LINKS, state, rates, |theta, omega, alpha| {
            self.0
                .accelerations_with(workspace, time, theta, omega, alpha);
        });
    }
}

/// A pendulum as a first-order system in symmetric coordinates: the state is
/// the coordinates followed by their rates. Holds a pendulum, or a reference to one.
#[derive(Clone, Copy, Debug)]
pub struct SymmetricCoordinates<P>(pub P);

impl<T: Scalar, P: SymmetricPendulum<T>> Ode<T> for SymmetricCoordinates<P> {
    fn dimension(&self) -> usize {
        2 * P::LINKS
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        second_order(
            P::LINKS,
            state,
            rates,
            |coordinates, velocities, accelerations| {
                self.0
                    .symmetric_accelerations_into(time, coordinates, velocities, accelerations);
            },
        );
    }
}

impl<T: Scalar, S: Scalar, P: Cast<T>> CastOde<T, S> for AbsoluteAngles<P> {
    type Of = AbsoluteAngles<P::Of<S>>;

    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of {
        AbsoluteAngles(self.0.cast(convert))
    }
}

impl<T: Scalar, P: Cast<T>> LaneOde<T> for AbsoluteAngles<P> {
    type Of<S: Scalar> = P::Of<S>;

    const DIMENSION: Option<usize> = Some(2 * P::LINKS);

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> P::Of<S> {
        self.0.cast(convert)
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(pendulum: &P::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        // As many as the compiler knows them to be.
        let (Some(state), Some(rates)) = (state.get(..2 * P::LINKS), rates.get_mut(..2 * P::LINKS))
        else {
            return;
        };
        let (theta, omega) = state.split_at(P::LINKS);
        let (velocities, alpha) = rates.split_at_mut(P::LINKS);
        for (rate, velocity) in velocities.iter_mut().zip(omega) {
            *rate = *velocity;
        }
        pendulum.evaluate(
            time,
            |link| at(theta, link),
            |link| at(omega, link),
            |link, value| put(alpha, link, value),
        );
    }
}

impl<T: Scalar, S: Scalar, P> CastOde<T, S> for SymmetricCoordinates<P>
where
    P: Cast<T> + SymmetricPendulum<T>,
    P::Of<S>: SymmetricPendulum<S>,
{
    type Of = SymmetricCoordinates<P::Of<S>>;

    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of {
        SymmetricCoordinates(self.0.cast(convert))
    }
}

/// q' = v, v' = a(q, v). Slices of another length than 2n have no answer, and
/// get NaN.
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
