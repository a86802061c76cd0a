//! Functions of a model, evaluated for many states.

use crate::model::Transfer;
use crate::scalar::Scalar;
use crate::sectors::Budget;
use crate::system::Pendulum;

/// A function of one state of a pendulum `P`, for any scalar type. It has `A` arguments with one
/// number per link. [`state_function!`](crate::state_function) creates it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a function of states of `{P}`",
    note = "write `state_function!(|model: Model, theta, omega| model.kinetic_energy(theta, omega))`"
)]
pub trait StateFunction<P: Pendulum<T>, T: Scalar, const A: usize> {
    /// Returns the values at `time` (s). `arguments` contains the arguments one after the other,
    /// each with one number per link; returns `None` if it is too short.
    fn call<S: Scalar>(
        pendulum: &P::Of<S>,
        time: S,
        arguments: &[S],
    ) -> Option<impl StateValues<S>>;
}

/// Numbers that a function of a model returns: a single number, an array, a
/// [`Transfer`](crate::Transfer), a [`Budget`](crate::Budget).
pub trait StateValues<S> {
    /// Number of numbers.
    const COUNT: usize;

    /// Passes each number with its index, counted from `first`, to `put`.
    fn write_to(self, first: usize, put: &mut impl FnMut(usize, S));
}

impl<S: Scalar> StateValues<S> for S {
    const COUNT: usize = 1;

    #[inline(always)]
    fn write_to(self, first: usize, put: &mut impl FnMut(usize, S)) {
        put(first, self);
    }
}

impl<S, V: StateValues<S>, const N: usize> StateValues<S> for [V; N] {
    const COUNT: usize = N * V::COUNT;

    #[inline(always)]
    fn write_to(self, first: usize, put: &mut impl FnMut(usize, S)) {
        for (index, value) in self.into_iter().enumerate() {
            value.write_to(first + index * V::COUNT, put);
        }
    }
}

impl<S: Scalar> StateValues<S> for Transfer<S> {
    const COUNT: usize = 2;

    #[inline(always)]
    fn write_to(self, first: usize, put: &mut impl FnMut(usize, S)) {
        [self.kinetic, self.potential].write_to(first, put);
    }
}

impl<S: Scalar, const N: usize> StateValues<S> for Budget<S, N> {
    const COUNT: usize = 3 * N;

    #[inline(always)]
    fn write_to(self, first: usize, put: &mut impl FnMut(usize, S)) {
        let Self {
            energies,
            transfers,
            powers,
        } = self;
        [energies, transfers, powers].write_to(first, put);
    }
}

/// A function of one state of a model, for [`Batch::evaluate`](crate::batch::Batch::evaluate): its
/// parameters are the model, the time (if the function depends on it), and arguments with one
/// number per link.
///
/// # Examples
///
/// Energy transfer and energy of 10,000 states:
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::state_function;
///
/// #[branched_pendulum(
///     gravity = 9.80665,
///     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
///         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
///     ],
///     emit(energies, transfer(exact)),
/// )]
/// struct Paper;
///
/// let model = Paper::new();
/// let angle = |k: usize, i: usize| (0.1 * (1 + k) as f64 + 1e-3 * i as f64).sin();
/// let q: [Vec<f64>; 3] = std::array::from_fn(|k| (0..10_000).map(|i| angle(k, i)).collect());
/// let p: [Vec<f64>; 3] = std::array::from_fn(|k| (0..10_000).map(|i| 1e-3 * angle(k, i)).collect());
/// let mut w = [vec![0.0; 10_000]];
///
/// let transfer = state_function!(|model: Paper, q, p| model.transfer_exact(q, p).total());
/// Batch::new(&model).evaluate(transfer, 0.0, [&q, &p], &mut w)?;
/// let alone = model.transfer_exact(&[q[0][7], q[1][7], q[2][7]], &[p[0][7], p[1][7], p[2][7]]);
/// assert!((w[0][7] - alone.total()).abs() < 1e-15);
///
/// // Several values: one slice for each.
/// let mut both = [vec![0.0; 10_000], vec![0.0; 10_000]];
/// let parts = state_function!(|model: Paper, q, p| model.transfer_exact(q, p));
/// Batch::new(&model).evaluate(parts, 0.0, [&q, &p], &mut both)?;
/// # Ok::<(), branched_pendulum::batch::BatchError>(())
/// ```
///
/// With the time of a driven pendulum:
/// `state_function!(|model: Driven, time; theta, omega| model.drive_power(time, theta, omega))`.
#[macro_export]
macro_rules! state_function {
    (|$model:ident: $kind:ty, $time:ident; $($arguments:ident),+| $value:expr) => {{
        const LINKS: usize = match <$kind as $crate::Model<f64>>::KNOWN_LINKS {
            ::core::option::Option::Some(links) => links,
            ::core::option::Option::None => ::core::panic!(
                "functions of states are those of a model whose type tells the number of links"
            ),
        };
        const ARGUMENTS: usize = [$(::core::stringify!($arguments)),+].len();
        type On<T> = <$kind as $crate::Model<f64>>::Of<T>;
        struct NamedFunction;
        impl<T: $crate::Scalar> $crate::batch::StateFunction<On<T>, T, ARGUMENTS> for NamedFunction {
            #[inline(always)]
            fn call<S: $crate::Scalar>(
                $model: &On<S>,
                $time: S,
                arguments: &[S],
            ) -> ::core::option::Option<impl $crate::batch::StateValues<S>> {
                let mut arguments = arguments.chunks_exact(LINKS);
                $(let $arguments: &[S; LINKS] = arguments.next()?.try_into().ok()?;)+
                ::core::option::Option::Some($value)
            }
        }
        NamedFunction
    }};
    (|$model:ident: $kind:ty, $($arguments:ident),+| $value:expr) => {
        $crate::state_function!(|$model: $kind, _time; $($arguments),+| $value)
    };
}
