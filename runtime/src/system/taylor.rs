//! Systems that compute the Taylor coefficients of their solutions.

use super::by_reference::by_reference;
use super::{AbsoluteAngles, Ode, Pendulum, Workspace};
use crate::scalar::Scalar;
use crate::simd::Quad;

/// A pendulum whose motion can be expanded in powers of time. Emitted code implements this trait if
/// the description has `emit(taylor)`; trees that are read at run time always implement it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know the Taylor coefficients of its motion",
    note = "a model knows them with `emit(taylor)` in its attribute"
)]
pub trait TaylorPendulum<T: Scalar>: Pendulum<T> {
    /// Returns the length of the buffer `work`, in groups of four numbers, for an expansion to
    /// order `order`.
    fn taylor_workspace(&self, order: usize) -> usize;

    /// Writes the Taylor coefficients of the motion through the angles `theta` (rad) and angular
    /// velocities `omega` (rad/s) at `time` (s).
    ///
    /// The coefficients of order k start at the index 2 k · links of `coefficients`: first those of
    /// all angles (rad/sᵏ), then those of all angular velocities (rad/sᵏ⁺¹). The length of
    /// `coefficients` determines the number of orders. `work` is a buffer of
    /// [`taylor_workspace`](Self::taylor_workspace) elements with any content. If lengths do not
    /// fit, the coefficients are NaN.
    fn taylor_coefficients_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        coefficients: &mut [T],
        work: &mut [Quad<T>],
    );

    /// Writes the Taylor coefficients for a pendulum with constants of the scalar type `S`. With
    /// vectors as scalars,
    /// [`Ensemble::integrate_in_lanes`](crate::ensemble::Ensemble::integrate_in_lanes) expands as
    /// many motions at a time as a vector register has lanes.
    ///
    /// Implementations should be `#[inline(always)]`: the caller chooses the instructions for which
    /// this is compiled.
    fn taylor_coefficients_of<S: Scalar>(
        pendulum: &Self::Of<S>,
        time: S,
        theta: &[S],
        omega: &[S],
        coefficients: &mut [S],
        work: &mut [Quad<S>],
    );
}

by_reference! {
    impl<T: Scalar> TaylorPendulum<T> for &P {
        for fn taylor_coefficients_of<S: Scalar>(
            pendulum: &Self::Of<S>, time: S, theta: &[S], omega: &[S], coefficients: &mut [S],
            work: &mut [Quad<S>]
        );
        fn taylor_workspace(&self, order: usize) -> usize;
        fn taylor_coefficients_into(
            &self, time: T, theta: &[T], omega: &[T], coefficients: &mut [T],
            work: &mut [Quad<T>]
        );
    }
}

/// First-order system y' = f(t, y) whose solution can be expanded in powers of time.
///
/// # Examples
///
/// y' = −y, with the coefficients (−1)ᵏ y₀ / k!:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::TaylorOde;
/// use branched_pendulum::taylor::Quad;
///
/// struct Decay;
///
/// impl Ode<f64> for Decay {
///     fn dimension(&self) -> usize {
///         1
///     }
///     fn rates(&self, _time: f64, state: &[f64], rates: &mut [f64]) {
///         rates[0] = -state[0];
///     }
/// }
///
/// impl TaylorOde<f64> for Decay {
///     fn workspace(&self, _order: usize) -> usize {
///         0
///     }
///     fn taylor(&self, _time: f64, state: &[f64], coefficients: &mut [f64], _: &mut [Quad<f64>]) {
///         let mut coefficient = state[0];
///         for (k, out) in coefficients.iter_mut().enumerate() {
///             *out = coefficient;
///             coefficient *= -1.0 / (k + 1) as f64;
///         }
///     }
/// }
///
/// let method = Taylor::new(Options::with_tolerance(1e-15));
/// let start = State::new(0.0, vec![1.0]);
/// let end = method.run(&Decay, &start, 1.0)?;
/// assert!((end.state.values[0] - (-1.0_f64).exp()).abs() < 1e-15);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know the Taylor coefficients of its solution",
    note = "the method `Taylor` takes `AbsoluteAngles(&model)` of a model with `emit(taylor)` in its attribute, or a `TaylorOde` of your own"
)]
pub trait TaylorOde<T>: Ode<T> {
    /// Returns true if the Taylor coefficients are known; if not,
    /// [`Taylor`](crate::integrate::Taylor) refuses to run.
    fn has_series(&self) -> bool {
        true
    }

    /// Returns the length of the buffer `work`, in groups of four numbers, for an expansion to
    /// order `order`.
    fn workspace(&self, order: usize) -> usize;

    /// Writes the Taylor coefficients of the solution through `state` at `time` (s).
    ///
    /// Coefficient k of component i is at the index k · [`dimension`](Ode::dimension) + i of
    /// `coefficients`, in units of the component per sᵏ. The length of `coefficients` determines
    /// the number of orders. `work` is a buffer of [`workspace`](Self::workspace) elements for that
    /// order, with any content.
    ///
    /// Writes NaN where the solution is undefined.
    fn taylor(&self, time: T, state: &[T], coefficients: &mut [T], work: &mut [Quad<T>]);
}

by_reference! {
    impl<T> TaylorOde<T> for &P where P: ?Sized {
        fn has_series(&self) -> bool;
        fn workspace(&self, order: usize) -> usize;
        fn taylor(&self, time: T, state: &[T], coefficients: &mut [T], work: &mut [Quad<T>]);
    }
}

impl<T: Scalar, P: TaylorPendulum<T>> TaylorOde<T> for AbsoluteAngles<P> {
    fn workspace(&self, order: usize) -> usize {
        self.0.taylor_workspace(order)
    }

    #[inline]
    fn taylor(&self, time: T, state: &[T], coefficients: &mut [T], work: &mut [Quad<T>]) {
        let links = self.0.links();
        if state.len() != 2 * links {
            coefficients.fill(T::from_f64(f64::NAN));
            return;
        }
        let (theta, omega) = state.split_at(links);
        self.0
            .taylor_coefficients_into(time, theta, omega, coefficients, work);
    }
}

/// System without Taylor coefficients, used where the type must be a [`TaylorOde`], for methods
/// that are chosen by name. Contains the system or a reference to it.
#[derive(Clone, Copy, Debug)]
pub struct RatesOnly<O>(pub O);

impl<T, O: Ode<T>> Ode<T> for RatesOnly<O> {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    #[inline]
    fn rates(&self, time: T, state: &[T], rates: &mut [T]) {
        self.0.rates(time, state, rates);
    }

    #[inline]
    fn rates_with(&self, workspace: &mut Workspace<T>, time: T, state: &[T], rates: &mut [T]) {
        self.0.rates_with(workspace, time, state, rates);
    }
}

impl<T: Scalar, O: Ode<T>> TaylorOde<T> for RatesOnly<O> {
    #[inline(always)]
    fn has_series(&self) -> bool {
        false
    }

    fn workspace(&self, _order: usize) -> usize {
        0
    }

    fn taylor(&self, _time: T, _state: &[T], coefficients: &mut [T], _work: &mut [Quad<T>]) {
        coefficients.fill(T::from_f64(f64::NAN));
    }
}
