//! Systems that ensembles integrate in the lanes of vector registers.

use super::Ode;
use crate::scalar::Scalar;

/// A system of equations whose constants can be converted to any scalar type.
/// [`Ensemble::integrate_in_lanes`](crate::ensemble::Ensemble::integrate_in_lanes) integrates as
/// many trajectories at a time as a vector register has lanes.
///
/// The conversion corresponds to [`Model::cast`](super::Model::cast) of models.
/// [`AbsoluteAngles`](super::AbsoluteAngles) of a model, [`UnderTorques`](super::UnderTorques) and
/// [`TransverseOde`](super::TransverseOde) implement it, and user-defined equations can implement
/// it too.
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
    /// The type of the system with constants of the scalar type `S`.
    type Of<S: Scalar>;

    /// Number of components of a state, if the type determines it; code for a known number is
    /// shorter.
    const DIMENSION: Option<usize> = None;

    /// Returns the system with each constant converted by `convert`, which must change the type of
    /// a constant but not its value. The order of the constants must be the same for all systems of
    /// a type.
    fn on_scalar<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;

    /// Writes the rates of a system with constants of the scalar type `S`, in the arithmetic of
    /// that type.
    ///
    /// Implementations should be `#[inline(always)]`: the caller chooses the instructions for which
    /// this is compiled.
    fn rates_of<S: Scalar>(system: &Self::Of<S>, time: S, state: &[S], rates: &mut [S]);

    /// Returns a number that differs between systems of one type that cannot be computed together
    /// in the lanes of one register. Constants may differ between systems with the same number.
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
