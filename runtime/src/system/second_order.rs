//! Functions of a model as systems of first-order equations.

use core::fmt;

use super::model::twice;
use super::ode::halves;
use super::{CastOde, LaneOde, Ode, Workspace};
use crate::scalar::Scalar;

/// Equations of second order: a function of a model, with what acts on it.
pub trait SecondOrder<T: Scalar> {
    /// Returns the number of coordinates.
    fn coordinates(&self) -> usize;

    /// Writes the rates of coordinates and velocities: velocities and accelerations. In memory
    /// that the caller keeps and fused arithmetic, or without any and in the arithmetic of `T`.
    fn rates(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: [&[T]; 2],
        rates: [&mut [T]; 2],
    );
}

/// Equations whose constants can be taken to any scalar.
pub trait CastSecondOrder<T: Scalar>: SecondOrder<T> {
    /// The equations on other scalars.
    type On<S: Scalar>: SecondOrder<S>;

    /// Number of coordinates, where the type tells it.
    const COORDINATES: Option<usize>;

    /// Takes every constant through `convert`.
    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::On<S>;

    /// Returns a number by which equations of one type differ that cannot stand in the lanes
    /// of one.
    fn shape(&self) -> usize;
}

/// What a caller hands over, as torques, which need not be something to show.
#[derive(Clone, Copy)]
pub struct HandedOver<A>(pub(super) A);

impl<A> fmt::Debug for HandedOver<A> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("..")
    }
}

/// A function of a model as a first-order system: the state is the coordinates followed by
/// their velocities. [`UnderTorques`](super::UnderTorques),
/// [`PrescribedOde`](super::PrescribedOde), [`TransverseOde`](super::TransverseOde),
/// [`SmallOde`](type@super::SmallOde), [`SmallUnderTorques`](super::SmallUnderTorques) and
/// [`SymmetricCoordinates`](type@super::SymmetricCoordinates) are some.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondOrderOde<E>(pub(super) E);

impl<E> SecondOrderOde<E> {
    #[inline(always)]
    fn write<T: Scalar>(
        &self,
        workspace: Option<&mut Workspace<T>>,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) where
        E: SecondOrder<T>,
    {
        let Self(equations) = self;
        if let Some((state, rates)) = halves(equations.coordinates(), state, rates) {
            equations.rates(workspace, time, state, rates);
        }
    }
}

impl<T: Scalar, E: SecondOrder<T>> Ode<T> for SecondOrderOde<E> {
    fn dimension(&self) -> usize {
        2 * self.0.coordinates()
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        self.write(Some(workspace), time, state, rates);
    }
}

impl<T: Scalar, E: CastSecondOrder<T>> LaneOde<T> for SecondOrderOde<E> {
    type Of<S: Scalar> = SecondOrderOde<E::On<S>>;

    const DIMENSION: Option<usize> = twice(E::COORDINATES);

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        SecondOrderOde(self.0.on(convert))
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        system.write(None, time, state, rates);
    }

    fn shape(&self) -> usize {
        self.0.shape()
    }
}

impl<T: Scalar, S: Scalar, E: CastSecondOrder<T>> CastOde<T, S> for SecondOrderOde<E> {
    type Of = SecondOrderOde<E::On<S>>;

    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of {
        SecondOrderOde(self.0.on(convert))
    }
}
