//! Equations of motion in absolute angles: one body of equations, on any scalar.

use core::marker::PhantomData;

use super::model::known;
use super::{Model, Workspace};
use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused;
use crate::simd::{Simd, StateKernel};

/// Equations of motion in absolute angles.
///
/// Angles are measured from the downward vertical (from the upward one where gravity is
/// written as negative), in radians; links stand in parent-before-child order.
///
/// A model says them once, as [`evaluate`](Self::evaluate) on its own scalars. The other
/// functions are forms of that one.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no equations of motion in `{T}`",
    note = "a model has them in its own numbers: `model.cast(…)` takes it to others, `linearised(AbsoluteAngles(&model))` to those of variational equations"
)]
pub trait Pendulum<T: Scalar>: Model<T> {
    /// The angular accelerations (rad/s²) at `time` (s), in the arithmetic of
    /// `T`: reads the angle (rad) and the angular velocity (rad/s) of link `i`
    /// as `theta(i)` and `omega(i)`, gives the results as `alpha(i, value)`.
    ///
    /// Write `#[inline(always)]`: the caller chooses the instructions that this
    /// is compiled for.
    fn evaluate(
        &self,
        time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        alpha: impl FnMut(usize, T),
    );

    /// Writes the angular accelerations, in rad/s², of a pendulum with angles
    /// `theta` (rad) and angular velocities `omega` (rad/s) at `time` (s).
    ///
    /// Models in `f64` and `f32` fuse products with sums where the machine
    /// can: [`scalar`](crate::scalar#which-bits).
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

    /// Writes the same accelerations as
    /// [`accelerations_into`](Self::accelerations_into), in memory that the caller
    /// keeps: for trees in loops, which would allocate it for every evaluation.
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

    /// Number of values that [`in_registers`](Self::in_registers) needs room
    /// for.
    #[doc(hidden)]
    fn room(&self) -> usize {
        0
    }

    /// The form in which a [`Batch`](crate::batch::Batch) computes at `time`:
    /// this pendulum in registers, or where that would be large, something that
    /// takes its numbers as they are needed.
    #[doc(hidden)]
    #[inline(always)]
    fn in_registers<R: Simd<T>>(&self, time: T, room: &mut [T]) -> impl InRegisters<R> {
        let _ = room;
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

    fn room(&self) -> usize {
        (**self).room()
    }

    #[inline(always)]
    fn in_registers<R: Simd<T>>(&self, time: T, room: &mut [T]) -> impl InRegisters<R> {
        (**self).in_registers(time, room)
    }
}

/// A pendulum in registers, at one time.
#[doc(hidden)]
pub trait InRegisters<R> {
    /// Evaluates as [`Pendulum::evaluate`] does.
    fn evaluate(
        &mut self,
        theta: impl Fn(usize) -> R,
        omega: impl Fn(usize) -> R,
        alpha: impl FnMut(usize, R),
    );
}

/// A pendulum whose constants are registers.
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

/// Writes the element at an index; nothing beyond the end, as [`at`] reads NaN
/// there.
#[inline(always)]
pub(crate) fn put<T>(numbers: &mut [T], index: usize, value: T) {
    if let Some(number) = numbers.get_mut(index) {
        *number = value;
    }
}

/// Returns true if all slices have one number a link; fills `alpha` with NaN if
/// not.
#[inline(always)]
fn fit<T: Scalar>(links: usize, theta: &[T], omega: &[T], alpha: &mut [T]) -> bool {
    let fit = theta.len() == links && omega.len() == links && alpha.len() == links;
    if !fit {
        alpha.fill(T::from_f64(f64::NAN));
    }
    fit
}

/// Writes accelerations in the arithmetic of `T`. Long ones are compiled once, not in
/// every place that falls back to them.
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

/// The accelerations of one state of a model whose type tells the number of links, its slices
/// as long. Of no links where it does not: then no state fits.
struct OneStateOf<P>(PhantomData<P>);

impl<T: Scalar, P: Pendulum<T>> StateKernel<T> for OneStateOf<P> {
    type Model = P;

    const LINKS: usize = known(P::KNOWN_LINKS);

    #[inline(always)]
    fn run<V: Simd<T>>(pendulum: &P, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        // Known already, and known again to the compiler of this function.
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
