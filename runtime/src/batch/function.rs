//! Functions of a model for many states.

use core::marker::PhantomData;

use super::{Batch, BatchError};
use crate::model::Transfer;
use crate::scalar::{Lane, Scalar};
use crate::sectors::Budget;
use crate::simd::{Kernel, Simd, dispatch};
use crate::system::{At, Computes, Forced, Model, Pendulum, SliceCounts, functions};

/// A function of one state of a pendulum `P`, on any scalar, of `A` arguments with a
/// number for each link: [`state_function!`](crate::state_function) writes it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no function of states of `{P}`",
    note = "write `state_function!(|model: Model, theta, omega| model.kinetic_energy(theta, omega))`"
)]
pub trait StateFunction<P: Pendulum<T>, T: Scalar, const A: usize> {
    /// Returns the values at `time` (s). `arguments` stand one after the other, with
    /// as many numbers each as there are links; None if they are fewer.
    fn call<S: Scalar>(
        pendulum: &P::Of<S>,
        time: S,
        arguments: &[S],
    ) -> Option<impl StateValues<S>>;
}

/// Numbers that a function of a model returns: one, an array, a
/// [`Transfer`](crate::Transfer), a [`Budget`](crate::Budget).
pub trait StateValues<S> {
    /// Number of numbers.
    const COUNT: usize;

    /// Tells each with its index, from `first` on.
    fn tell(self, first: usize, put: &mut impl FnMut(usize, S));
}

impl<S: Scalar> StateValues<S> for S {
    const COUNT: usize = 1;

    #[inline(always)]
    fn tell(self, first: usize, put: &mut impl FnMut(usize, S)) {
        put(first, self);
    }
}

impl<S, V: StateValues<S>, const N: usize> StateValues<S> for [V; N] {
    const COUNT: usize = N * V::COUNT;

    #[inline(always)]
    fn tell(self, first: usize, put: &mut impl FnMut(usize, S)) {
        for (index, value) in self.into_iter().enumerate() {
            value.tell(first + index * V::COUNT, put);
        }
    }
}

impl<S: Scalar> StateValues<S> for Transfer<S> {
    const COUNT: usize = 2;

    #[inline(always)]
    fn tell(self, first: usize, put: &mut impl FnMut(usize, S)) {
        [self.kinetic, self.potential].tell(first, put);
    }
}

impl<S: Scalar, const N: usize> StateValues<S> for Budget<S, N> {
    const COUNT: usize = 3 * N;

    #[inline(always)]
    fn tell(self, first: usize, put: &mut impl FnMut(usize, S)) {
        let Self {
            energies,
            transfers,
            powers,
        } = self;
        [energies, transfers, powers].tell(first, put);
    }
}

/// A function of one state of a model, for [`Batch::evaluate`]: the model, arguments
/// with a number for each link, and the value that they give. Where the time matters,
/// it stands behind the model.
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

impl<P: Pendulum<T>, T: Lane> Batch<'_, P, T> {
    /// Writes the values of a [`state_function!`](crate::state_function) at `time`
    /// (s): of each argument one slice for each link, of `values` one slice for each
    /// number that the function returns, and in each slice one number for each state.
    ///
    /// Each state gets the same bits whatever its place in the batch: those that the
    /// function gives alone, but for what is [fused](crate::scalar#which-bits).
    /// Allocates some numbers for each link.
    ///
    /// # Errors
    /// [`BatchError`] unless there are as many slices as links and values, and all
    /// have one length; nothing is written then.
    ///
    /// # Examples
    /// See [`state_function!`](crate::state_function).
    pub fn evaluate<F, const A: usize>(
        &mut self,
        function: F,
        time: T,
        arguments: [&[impl AsRef<[T]>]; A],
        values: &mut [impl AsMut<[T]>],
    ) -> Result<(), BatchError>
    where
        F: StateFunction<P, T, A>,
    {
        let _ = function;
        let first = arguments.first().and_then(|argument| argument.first());
        let count = first.map_or(0, |states| states.as_ref().len());
        for argument in arguments {
            let lengths = argument.iter().map(|s| s.as_ref().len());
            super::check(
                self.pendulum.links(),
                count,
                "arguments",
                argument.len(),
                lengths,
            )?;
        }
        let expected = number_of_values(F::call::<T>);
        if values.len() != expected {
            let found = values.len();
            return Err(BatchError::Values { expected, found });
        }
        let found = values.len();
        let lengths = values.iter_mut().map(|s| s.as_mut().len());
        super::check(found, count, "values", found, lengths)?;
        let states = FunctionOfStates {
            function: PhantomData::<ValuesOf<F, A>>,
            pendulum: self.pendulum,
            time,
            count,
            arguments,
            values,
        };
        dispatch::run_in_registers(self.instructions, states);
        Ok(())
    }

    /// Writes the angular accelerations (rad/s²) at `time` (s) of states with torques
    /// from outside (N m): slices as for [`accelerations`](Self::accelerations).
    ///
    /// Each state gets the same bits whatever its place in the batch. Allocates some
    /// numbers for each link.
    ///
    /// # Errors
    /// As for [`accelerations`](Self::accelerations).
    pub fn accelerations_under(
        &mut self,
        time: T,
        [theta, omega, torques]: [&[impl AsRef<[T]>]; 3],
        alpha: &mut [impl AsMut<[T]>],
    ) -> Result<(), BatchError>
    where
        P: Forced<T>,
    {
        let count = theta.first().map_or(0, |states| states.as_ref().len());
        for (name, argument) in [("theta", theta), ("omega", omega), ("torques", torques)] {
            let lengths = argument.iter().map(|s| s.as_ref().len());
            super::check(self.pendulum.links(), count, name, argument.len(), lengths)?;
        }
        let found = alpha.len();
        let lengths = alpha.iter_mut().map(|s| s.as_mut().len());
        super::check(self.pendulum.links(), count, "alpha", found, lengths)?;
        let states = FunctionOfStates {
            function: PhantomData::<Applied<functions::AccelerationsUnderTorques, 3>>,
            pendulum: self.pendulum,
            time,
            count,
            arguments: [theta, omega, torques],
            values: alpha,
        };
        dispatch::run_in_registers(self.instructions, states);
        Ok(())
    }
}

/// A function of states in registers.
trait RegisterFunction<P, T: Scalar> {
    /// The model on another scalar.
    type On<S: Scalar>;

    /// Takes the model to another scalar.
    fn on<S: Scalar>(pendulum: &P, convert: impl Fn(T) -> S) -> Self::On<S>;

    /// Tells the values with their indices; `alpha` is room for one number a link. None
    /// where there are fewer arguments than it takes.
    fn tell<S: Scalar>(
        pendulum: &Self::On<S>,
        time: S,
        arguments: &[S],
        alpha: &mut [S],
        put: &mut impl FnMut(usize, S),
    ) -> Option<()>;
}

/// Result of a [`StateFunction`].
struct ValuesOf<F, const A: usize>(PhantomData<F>);

impl<P, T, F, const A: usize> RegisterFunction<P, T> for ValuesOf<F, A>
where
    P: Pendulum<T>,
    T: Scalar,
    F: StateFunction<P, T, A>,
{
    type On<S: Scalar> = P::Of<S>;

    #[inline(always)]
    fn on<S: Scalar>(pendulum: &P, convert: impl Fn(T) -> S) -> P::Of<S> {
        pendulum.cast(convert)
    }

    #[inline(always)]
    fn tell<S: Scalar>(
        pendulum: &P::Of<S>,
        time: S,
        arguments: &[S],
        _: &mut [S],
        put: &mut impl FnMut(usize, S),
    ) -> Option<()> {
        F::call::<S>(pendulum, time, arguments)?.tell(0, put);
        Some(())
    }
}

/// A function `F` of a model, of `A` arguments with a number for each link.
struct Applied<F, const A: usize>(PhantomData<F>);

impl<F: SliceCounts, P: Computes<F, T>, T: Scalar, const A: usize> RegisterFunction<P, T>
    for Applied<F, A>
{
    type On<S: Scalar> = P::On<S>;

    #[inline(always)]
    fn on<S: Scalar>(pendulum: &P, convert: impl Fn(T) -> S) -> P::On<S> {
        pendulum.on(convert)
    }

    #[inline(always)]
    fn tell<S: Scalar>(
        pendulum: &P::On<S>,
        time: S,
        arguments: &[S],
        alpha: &mut [S],
        put: &mut impl FnMut(usize, S),
    ) -> Option<()> {
        let mut rest = arguments;
        let mut given: [&[S]; A] = [&[]; A];
        for own in &mut given {
            (*own, rest) = rest.split_at_checked(pendulum.links())?;
        }
        pendulum.compute(At::time(time), &given, &mut [alpha]);
        for (link, &value) in alpha.iter().enumerate() {
            put(link, value);
        }
        Some(())
    }
}

fn number_of_values<'a, M: 'a, S: 'a, V: StateValues<S>>(
    _: impl Fn(&'a M, S, &'a [S]) -> Option<V>,
) -> usize {
    V::COUNT
}

/// All states; lengths checked.
struct FunctionOfStates<'a, F, P, T, In, Out, const A: usize> {
    function: PhantomData<F>,
    pendulum: &'a P,
    time: T,
    count: usize,
    arguments: [&'a [In]; A],
    values: &'a mut [Out],
}

impl<F, P, T, In, Out, const A: usize> Kernel<T> for FunctionOfStates<'_, F, P, T, In, Out, A>
where
    F: RegisterFunction<P, T>,
    P: Pendulum<T>,
    T: Lane,
    In: AsRef<[T]>,
    Out: AsMut<[T]>,
{
    type Output = ();

    /// A register of states after the other; the last one overlaps the one before where
    /// it would not be full.
    #[inline(always)]
    fn run<R: Simd<T>>(self) {
        let pendulum = F::on(self.pendulum, R::splat);
        let links = self.pendulum.links();
        let time = R::splat(self.time);
        let mut arguments = alloc::vec![R::splat(T::from_f64(0.0)); A * links];
        let mut alpha = alloc::vec![R::splat(T::from_f64(0.0)); links];
        // Where there are fewer states than lanes.
        let mut few = alloc::vec![T::from_f64(0.0); R::LANES];
        let mut next = 0;
        while next < self.count {
            let start = next.min(self.count.saturating_sub(R::LANES));
            let slices = self.arguments.iter().flat_map(|argument| argument.iter());
            for (place, slice) in arguments.iter_mut().zip(slices) {
                *place = R::load_front(slice.as_ref().get(start..).unwrap_or_default());
            }
            let mut put = |index: usize, value: R| {
                let slice = self.values.get_mut(index).map(AsMut::as_mut);
                let states = slice.and_then(|slice| slice.get_mut(start..));
                let states = states.unwrap_or_default();
                if states.len() >= R::LANES {
                    value.store(states);
                } else {
                    value.store(&mut few);
                    for (state, lane) in states.iter_mut().zip(&few) {
                        *state = *lane;
                    }
                }
            };
            if F::tell::<R>(&pendulum, time, &arguments, &mut alpha, &mut put).is_none() {
                return;
            }
            next = start + R::LANES;
        }
    }
}
