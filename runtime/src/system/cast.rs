//! One body of equations, on any scalar.

use core::marker::PhantomData;

use crate::scalar::{Scalar, at};
use crate::simd::dispatch::in_fused;
use crate::simd::{Simd, StateKernel};

use super::{Ode, Pendulum};

/// A pendulum whose constants can be taken to other scalars.
///
/// This is how [`Batch`](crate::batch::Batch) brings a model of plain numbers
/// into vector registers, and how one state gets the machine's fused
/// multiply-adds. Models written by the attribute implement it.
///
/// # Examples
///
/// A rod, written by hand:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::Cast;
///
/// struct Rod<T>(T);
///
/// impl<T: Scalar> Pendulum<T> for Rod<T> {
///     const LINKS: usize = 1;
///     const LINK_NAMES: &'static [&'static str] = &["rod"];
///
///     fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
///         self.accelerate(time, theta, omega, alpha);
///     }
/// }
///
/// impl<T: Scalar> Cast<T> for Rod<T> {
///     type Of<S: Scalar> = Rod<S>;
///
///     #[inline(always)]
///     fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
///         Rod(convert(self.0))
///     }
///
///     #[inline(always)]
///     fn evaluate(
///         &self,
///         _time: T,
///         theta: impl Fn(usize) -> T,
///         _omega: impl Fn(usize) -> T,
///         mut alpha: impl FnMut(usize, T),
///     ) {
///         alpha(0, -(self.0 * theta(0).sin_cos().0));
///     }
/// }
///
/// let model = Rod(9.80665);
/// let theta = [vec![0.1; 1001]];
/// let omega = [vec![0.0; 1001]];
/// let mut alpha = [vec![0.0; 1001]];
/// Batch::new(&model).accelerations(0.0, &theta, &omega, &mut alpha)?;
/// let mut alone = [0.0];
/// model.accelerations_into(0.0, &[0.1], &[0.0], &mut alone);
/// assert_eq!(alpha[0][1000], alone[0]);
/// # Ok::<(), branched_pendulum::batch::BatchError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be taken from `{T}` to other numbers",
    note = "models of the attribute can, in their own numbers: the model itself or `&model`, not one in coordinates like `AbsoluteAngles(&model)`, which is a `CastOde`"
)]
pub trait Cast<T: Scalar>: Pendulum<T> {
    /// This pendulum on other scalars.
    type Of<S: Scalar>: Cast<S>;

    /// Takes every constant through `convert`, which should change their type
    /// and not their value.
    ///
    /// All models of a type must convert as many constants in the same order, and
    /// differ in nothing else: this is how
    /// [`Ensemble::integrate_models_in_lanes`](crate::ensemble::Ensemble::integrate_models_in_lanes)
    /// puts several models into the lanes of one.
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S>;

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

    /// Number of values that [`in_registers`](Self::in_registers) needs room
    /// for.
    #[doc(hidden)]
    fn room(&self) -> usize {
        0
    }

    /// Writes the angular accelerations as
    /// [`Pendulum::accelerations_into`] of emitted models does: in fused
    /// arithmetic where the type and the machine have it, otherwise in that of `T`.
    #[inline(always)]
    fn accelerate(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T])
    where
        Self: Sized,
    {
        if fit::<T, Self>(theta, omega, alpha)
            && !in_fused::<T, OneStateOf<Self>>(self, time, theta, omega, alpha)
        {
            unfused(self, time, theta, omega, alpha);
        }
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

impl<T: Scalar, P: Cast<T>> Cast<T> for &P {
    type Of<S: Scalar> = P::Of<S>;

    #[inline(always)]
    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Self::Of<S> {
        (**self).cast(convert)
    }

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

    fn room(&self) -> usize {
        (**self).room()
    }

    #[inline(always)]
    fn accelerate(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        (**self).accelerate(time, theta, omega, alpha);
    }

    #[inline(always)]
    fn in_registers<R: Simd<T>>(&self, time: T, room: &mut [T]) -> impl InRegisters<R> {
        (**self).in_registers(time, room)
    }
}

/// A system of equations that can be taken to the scalar `S`: a model in its
/// coordinates.
///
/// # Examples
///
/// One motion in double-double numbers beside that in `f64`, and what rounding did to
/// the latter:
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
    message = "`{Self}` cannot be taken from `{T}` to `{S}`",
    note = "`AbsoluteAngles(&model)`, `SymmetricCoordinates(&model)` and `CanonicalVariables(&model)` can; equations that are generic over the scalar need not be"
)]
pub trait CastOde<T, S>: Ode<T> {
    /// The system on that scalar.
    type Of: Ode<S>;

    /// Takes every constant through `convert`, which should change their type and not
    /// their value.
    fn cast(&self, convert: impl Fn(T) -> S) -> Self::Of;
}

/// A pendulum in registers, at one time.
#[doc(hidden)]
pub trait InRegisters<R> {
    /// Evaluates as [`Cast::evaluate`] does.
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

impl<R: Scalar, P: Cast<R>> InRegisters<R> for CastPendulum<P, R> {
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
fn fit<T: Scalar, P: Pendulum<T>>(theta: &[T], omega: &[T], alpha: &mut [T]) -> bool {
    let fit = theta.len() == P::LINKS && omega.len() == P::LINKS && alpha.len() == P::LINKS;
    if !fit {
        alpha.fill(T::from_f64(f64::NAN));
    }
    fit
}

/// Writes accelerations in the arithmetic of `T`. Long ones are compiled once, not in
/// every place that falls back to them.
#[inline]
pub(crate) fn unfused<T: Scalar, P: Cast<T>>(
    pendulum: &P,
    time: T,
    theta: &[T],
    omega: &[T],
    alpha: &mut [T],
) {
    if fit::<T, P>(theta, omega, alpha) {
        pendulum.evaluate(
            time,
            |i| at(theta, i),
            |i| at(omega, i),
            |i, value| put(alpha, i, value),
        );
    }
}

/// The accelerations of one state, its slices as long as there are links.
struct OneStateOf<P>(PhantomData<P>);

impl<T: Scalar, P: Cast<T>> StateKernel<T> for OneStateOf<P> {
    type Model = P;

    const LINKS: usize = P::LINKS;

    #[inline(always)]
    fn run<V: Simd<T>>(pendulum: &P, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
        // Known already, and known again to the compiler of this function.
        if !fit::<T, P>(theta, omega, alpha) {
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
