//! Systems that ensembles take into the lanes of vector registers.

use super::Ode;
use crate::scalar::Scalar;

/// A system of equations whose constants can be taken to any scalar: so
/// [`Ensemble::integrate_in_lanes`](crate::ensemble::Ensemble::integrate_in_lanes)
/// integrates as many trajectories at a time as a vector register holds.
///
/// As [`Model::cast`](super::Model::cast) is for models, this is for their systems:
/// [`AbsoluteAngles`](super::AbsoluteAngles) of a model,
/// [`UnderTorques`](super::UnderTorques), [`TransverseOde`](super::TransverseOde), or
/// equations of your own.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::LaneOde;
///
/// /// y'' = −k y.
/// struct Spring<T>(T);
///
/// impl<T: Scalar> Ode<T> for Spring<T> {
///     fn dimension(&self) -> usize {
///         2
///     }
///     fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
///         Self::rates_of(self, time, state, rates);
///     }
/// }
///
/// impl<T: Scalar> LaneOde<T> for Spring<T> {
///     type Of<S: Scalar> = Spring<S>;
///
///     fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Spring<S> {
///         Spring(convert(self.0))
///     }
///
///     #[inline(always)]
///     fn rates_of<S: Scalar>(system: &Spring<S>, _: S, state: &[S], rates: &mut [S]) {
///         rates[0] = state[1];
///         rates[1] = -(system.0 * state[0]);
///     }
/// }
///
/// let starts = [0.1, 0.2, 0.3].map(|y| State::at_rest(0.0, &[y]));
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let ends = Ensemble::new().integrate_in_lanes(&method, &Spring(1.0), &starts, 1.0);
/// assert!((ends[2].as_ref().unwrap().state.values[0] - 0.3 * 1.0_f64.cos()).abs() < 1e-11);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be taken into lanes of `{T}`",
    note = "a model can in its coordinates, `AbsoluteAngles(&model)`; torques of `UnderTorques` that are `LaneTorques`; equations of your own with `LaneOde`"
)]
pub trait LaneOde<T: Scalar>: Ode<T> {
    /// This system on other scalars.
    type Of<S: Scalar>;

    /// Number of components of a state, where the type tells it: code for a known
    /// number is shorter.
    const DIMENSION: Option<usize> = None;

    /// Takes every constant through `convert`, which should change their type and not
    /// their value, in the same order for all systems of a type.
    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;

    /// Writes the rates of a system on other scalars, in their arithmetic.
    ///
    /// Write `#[inline(always)]`: the caller chooses the instructions that this is
    /// compiled for.
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]);

    /// Number by which systems of one type differ that cannot stand in the lanes of
    /// one, whatever their constants.
    fn shape(&self) -> usize {
        0
    }
}

impl<T: Scalar, O: LaneOde<T>> LaneOde<T> for &O {
    type Of<S: Scalar> = O::Of<S>;

    const DIMENSION: Option<usize> = O::DIMENSION;

    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        (**self).on_scalar(convert)
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]) {
        O::rates_of(system, time, state, rates);
    }

    fn shape(&self) -> usize {
        (**self).shape()
    }
}
