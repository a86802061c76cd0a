//! Systems of equations that can be converted to other scalar types.

use super::{Ode, Workspace};
use crate::scalar::Scalar;

/// A system of equations whose constants can be converted to any scalar type, such as a model in its
/// coordinates. [`Ensemble::integrate_in_lanes`](crate::ensemble::Ensemble::integrate_in_lanes)
/// integrates as many trajectories at a time as a vector register has lanes;
/// [`linearised`](crate::analysis::variational::linearised) adds variational equations.
///
/// The conversion corresponds to [`Model::cast`](super::Model::cast) of models.
/// [`AbsoluteAngles`](super::AbsoluteAngles) of a model and every [`Motion`](super::Motion) implement
/// this trait, and user-defined equations can implement it too.
///
/// # Examples
///
/// User-defined equations:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::CastOde;
///
/// /// y'' = −k y.
/// struct Spring<T>(T);
///
/// impl<T: Scalar> Ode<T> for Spring<T> {
///     fn dimension(&self) -> usize {
///         2
///     }
///     #[inline(always)]
///     fn rates(&self, _: T, state: &[T], rates: &mut [T]) {
///         rates[0] = state[1];
///         rates[1] = -(self.0 * state[0]);
///     }
/// }
///
/// impl<T: Scalar> CastOde<T> for Spring<T> {
///     type Of<S: Scalar> = Spring<S>;
///
///     fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Spring<S> {
///         Spring(convert(self.0))
///     }
/// }
///
/// let starts = [0.1, 0.2, 0.3].map(|y| State::at_rest(0.0, &[y]));
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let ends = Ensemble::new().integrate_in_lanes(&method, &Spring(1.0), &starts, 1.0);
/// assert!((ends[2].as_ref().unwrap().state.values[0] - 0.3 * 1.0_f64.cos()).abs() < 1e-11);
/// ```
///
/// This example compares the rates in double-double numbers with those in `f64`, to see the effect
/// of rounding:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::scalar::Double;
/// use branched_pendulum::system::CastOde;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     upper: rod(mass = upper_mass, length = 0.5) [lower: rod(mass = 0.25, length = 0.5)],
/// )]
/// struct Pair;
///
/// let model = Pair::new(PairParameters { upper_mass: 0.75 })?;
/// let plain = AbsoluteAngles(&model);
/// let precise = plain.cast(Double::from_f64);
///
/// let state = [0.4, -0.7, 1.5, 0.2];
/// let (mut rates, mut more) = ([0.0; 4], [Double::from_f64(0.0); 4]);
/// plain.rates(0.0, &state, &mut rates);
/// precise.rates(Double::from_f64(0.0), &state.map(Double::from_f64), &mut more);
/// for (rate, more) in rates.into_iter().zip(more) {
///     assert!((Double::from_f64(rate) - more).to_f64().abs() < 1e-13);
/// }
/// # Ok::<(), ParameterError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be converted from `{T}` to other scalars",
    note = "a model can in its coordinates, `AbsoluteAngles(&model)`, `SymmetricCoordinates(&model)` or `CanonicalVariables(&model)`; torques of `UnderTorques` that are a `CastAction`; equations of your own with `CastOde`"
)]
pub trait CastOde<T: Scalar>: Ode<T> {
    /// The type of the system with constants of the scalar type `S`.
    type Of<S: Scalar>: Ode<S>;

    /// Number of components of a state, if the type determines it; code for a known number is
    /// shorter.
    const DIMENSION: Option<usize> = None;

    /// Returns the system with each constant converted by `convert`, which must change the type of
    /// a constant but not its value. The order of the constants must be the same for all systems of
    /// a type.
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;

    /// Writes the rates of a converted system in the arithmetic of `S`, as ensembles in lanes need
    /// them, with a workspace that the caller keeps. Override this if [`Ode::rates`] uses other
    /// arithmetic or needs memory.
    ///
    /// This function and [`Ode::rates`] should be `#[inline(always)]`: the caller chooses the
    /// instructions for which they are compiled.
    #[inline(always)]
    fn rates_of<S: Scalar>(
        system: &Self::Of<S>,
        workspace: &mut Workspace<S>,
        time: S,
        state: &[S],
        rates: &mut [S],
    ) {
        let _ = workspace;
        system.rates(time, state, rates);
    }

    /// Returns a number that differs between systems of one type that cannot be computed together
    /// in the lanes of one register. Constants may differ between systems with the same number.
    fn shape(&self) -> usize {
        0
    }
}

impl<T: Scalar, O: CastOde<T>> CastOde<T> for &O {
    type Of<S: Scalar> = O::Of<S>;

    const DIMENSION: Option<usize> = O::DIMENSION;

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        (**self).cast(convert)
    }

    #[inline(always)]
    fn rates_of<S: Scalar>(
        system: &Self::Of<S>,
        workspace: &mut Workspace<S>,
        time: S,
        state: &[S],
        rates: &mut [S],
    ) {
        O::rates_of(system, workspace, time, state, rates);
    }

    fn shape(&self) -> usize {
        (**self).shape()
    }
}
