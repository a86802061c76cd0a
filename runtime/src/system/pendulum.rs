//! Equations of motion in absolute angles, in a form that every scalar type can use.

use core::marker::PhantomData;

use super::function::{At, Computes, functions};
use super::model::known;
use super::{Model, Workspace};
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused;
use crate::simd::{Simd, StateKernel};

/// Equations of motion in absolute angles.
///
/// Angles are measured from the downward vertical (from the upward one if the description's gravity
/// is negative), in radians; parents come before their children in the order of links.
///
/// A model implements them in [`evaluate`](Self::evaluate), which the other functions call.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of motion in `{T}`",
    note = "a model has them in its own numbers: `model.cast(…)` takes it to others, `linearised(AbsoluteAngles(&model))` to those of variational equations"
)]
pub trait Pendulum<T: Scalar>: Model<T> {
    /// Computes the angular accelerations (rad/s²) at `time` (s), in the arithmetic of `T`. It
    /// reads the angle (rad) and the angular velocity (rad/s) of link `i` as `theta(i)` and
    /// `omega(i)`, and returns each result by calling `alpha(i, value)`.
    ///
    /// Implementations should be `#[inline(always)]`: the caller chooses the instructions for which
    /// this is compiled.
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    );

    /// Writes the accelerations that [`evaluate`](Self::evaluate) computes, in the arithmetic of `T`
    /// and with a workspace that the caller keeps. Ensembles in lanes call it with slices of one
    /// number for each link.
    #[doc(hidden)]
    #[inline(always)]
    fn evaluate_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        [theta, omega]: [&[T]; 2],
        alpha: &mut [T],
    ) {
        let _ = workspace;
        self.evaluate(
            time,
            |i| at(theta, i),
            |i| at(omega, i),
            |i, value| put(alpha, i, value),
        );
    }

    /// Writes the angular accelerations (rad/s²) of a pendulum with angles `theta` (rad) and
    /// angular velocities `omega` (rad/s) at `time` (s).
    ///
    /// Models in `f64` and `f32` use fused multiply–add if the machine has it:
    /// [`scalar`](crate::scalar#which-bits).
    ///
    /// All three slices have one number for each [link](Model::links). For other lengths the
    /// results are NaN.
    #[inline]
    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        if fit(self.links(), theta, omega, alpha)
            && !in_fused::<T, OneStateOf<Self>>(self, time, theta, omega, alpha)
        {
            unfused(self, time, theta, omega, alpha);
        }
    }

    /// Writes the same accelerations as [`accelerations_into`](Self::accelerations_into), with a
    /// workspace that the caller keeps. Large trees, whose code loops over the links, would
    /// otherwise allocate it in every evaluation.
    #[inline]
    fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        let _ = workspace;
        self.accelerations_into(time, theta, omega, alpha);
    }

    /// Writes the angular accelerations (rad/s²) like
    /// [`accelerations_into`](Self::accelerations_into), with generalized torques Q (N m) in
    /// addition to all others: M θ̈ + b = Q. Their power is Q·ω. All slices have one number for each
    /// [link](Model::links); for other lengths the results
    /// are NaN. Compiled models have this function if the description has `emit(forces)`.
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
    ) where
        Self: Computes<functions::AccelerationsUnderTorques, T>,
    {
        let workspace = &mut Workspace::new();
        self.accelerations_under_with(workspace, time, theta, omega, torques, alpha);
    }

    /// Writes the same accelerations, using memory that the caller keeps, as
    /// [`accelerations_with`](Self::accelerations_with) does.
    #[inline]
    fn accelerations_under_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        torques: &[T],
        alpha: &mut [T],
    ) where
        Self: Computes<functions::AccelerationsUnderTorques, T>,
    {
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
    /// each [link](Model::links); for other lengths the results are NaN. Compiled models
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
    /// [`accelerations_with`](Self::accelerations_with) does.
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

    /// Writes the rates of the angles `theta` (rad) and of their `momenta` (kg m²/s) at `time` (s):
    /// Hamilton's equations. All slices have one number for each [link](Model::links); for other
    /// lengths the results are NaN. Compiled models have this function if the description has
    /// `emit(momenta)`. [`CanonicalVariables`](type@super::CanonicalVariables) is the system that
    /// integrators take.
    #[inline]
    fn canonical_rates_into(
        &self,
        time: T,
        theta: &[T],
        momenta: &[T],
        angle_rates: &mut [T],
        momentum_rates: &mut [T],
    ) where
        Self: Computes<functions::CanonicalRates, T>,
    {
        let results = &mut [angle_rates, momentum_rates];
        let workspace = &mut Workspace::new();
        self.compute_with(workspace, At::time(time), &[theta, momenta], results);
    }

    /// Returns the length of the buffer that [`in_registers`](Self::in_registers) needs.
    #[doc(hidden)]
    fn workspace_len(&self) -> usize {
        0
    }

    /// Prepares this pendulum for evaluation by a [`Batch`](crate::batch::Batch) at `time` (s): its
    /// constants are converted to registers or, if there are many, loaded as needed. `room` is a
    /// buffer for them.
    #[doc(hidden)]
    #[inline(always)]
    fn in_registers<R: Simd<T>>(&self, time: T, buffer: &mut [T]) -> impl InRegisters<R> {
        let _ = buffer;
        CastPendulum {
            pendulum: self.cast(R::splat),
            time: R::splat(time),
        }
    }
}

impl<T: Scalar, P: Pendulum<T>> Pendulum<T> for &P {
    #[inline(always)]
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    ) {
        (**self).evaluate(time, theta, omega, alpha);
    }

    #[inline(always)]
    fn evaluate_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        given: [&[T]; 2],
        alpha: &mut [T],
    ) {
        (**self).evaluate_with(workspace, time, given, alpha);
    }

    #[inline]
    fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        (**self).accelerations_into(time, theta, omega, alpha);
    }

    #[inline]
    fn accelerations_with(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        theta: &[T],
        omega: &[T],
        alpha: &mut [T],
    ) {
        (**self).accelerations_with(workspace, time, theta, omega, alpha);
    }

    fn workspace_len(&self) -> usize {
        (**self).workspace_len()
    }

    #[inline(always)]
    fn in_registers<R: Simd<T>>(&self, time: T, buffer: &mut [T]) -> impl InRegisters<R> {
        (**self).in_registers(time, buffer)
    }
}

/// Pendulum prepared for evaluation in vector registers, at one time.
#[doc(hidden)]
pub trait InRegisters<R> {
    /// Computes the angular accelerations like [`Pendulum::evaluate`].
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    );
}

/// Pendulum whose constants have been converted to vector registers.
struct CastPendulum<P, R> {
    pendulum: P,
    time: R,
}

impl<R: Scalar, P: Pendulum<R>> InRegisters<R> for CastPendulum<P, R> {
    #[inline(always)]
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    ) {
        self.pendulum.evaluate(self.time, theta, omega, alpha);
    }
}

/// Writes an element at an index; does nothing if the index is beyond the end ([`at`] returns NaN
/// there).
#[inline(always)]
pub(crate) fn put<T>(numbers: &mut [T], index: usize, value: T) {
    if let Some(number) = numbers.get_mut(index) {
        *number = value;
    }
}

/// Returns true if all slices have one number per link; otherwise fills `alpha` with NaN and
/// returns false.
#[inline(always)]
fn fit<T: Scalar>(links: usize, theta: &[T], omega: &[T], alpha: &mut [T]) -> bool {
    let fit = theta.len() == links && omega.len() == links && alpha.len() == links;
    if !fit {
        alpha.fill(T::from_f64(f64::NAN));
    }
    fit
}

/// Writes accelerations in the arithmetic of `T`, without fused multiply–add. As a separate
/// function, long code is compiled once instead of at each caller.
#[inline]
pub(crate) fn unfused<T: Scalar, P: Pendulum<T>>(
    pendulum: &P,
    time: T,
    theta: &[T],
    omega: &[T],
    alpha: &mut [T],
) {
    if fit(pendulum.links(), theta, omega, alpha) {
        pendulum.evaluate(
            time,
            |i| at(theta, i),
            |i| at(omega, i),
            |i, value| put(alpha, i, value),
        );
    }
}

/// Computation of one state's accelerations by a model whose type determines the number of links,
/// for slices of that length. If the type does not determine it, the number of links counts as
/// zero, and no state has a matching length.
struct OneStateOf<P>(PhantomData<P>);

impl<T: Scalar, P: Pendulum<T>> StateKernel<T> for OneStateOf<P> {
    type Model = P;

    const LINKS: usize = known(P::KNOWN_LINKS);

    #[inline(always)]
    fn run<V: Simd<T>>(pendulum: &P, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        // Checks the lengths again, so that the compiler of this function knows them.
        if !fit(pendulum.links(), theta, omega, alpha) {
            return;
        }
        pendulum.cast(V::splat).evaluate(
            V::splat(time),
            |i| V::splat(at(theta, i)),
            |i| V::splat(at(omega, i)),
            |i, value| {
                if let Some(rest) = alpha.get_mut(i..) {
                    value.store(rest);
                }
            },
        );
    }
}
