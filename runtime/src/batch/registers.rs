//! Evaluation of functions of states, one vector register of states at a time.

use core::marker::PhantomData;

use super::function::{StateFunction, StateValues};
use crate::scalar::{Lane, Scalar};
use crate::simd::{Kernel, Simd};
use crate::system::{At, Computes, Pendulum, SliceFunction};

/// A function of states that can be evaluated in vector registers.
pub(super) trait RegisterFunction<P, T: Scalar> {
    /// The model on another scalar.
    type On<S: Scalar>;

    /// Converts the model to another scalar type.
    fn on<S: Scalar>(pendulum: &P, convert: impl Fn(T) -> S) -> Self::On<S>;

    /// Computes the values and passes them with their indices to `put`; `values` is a buffer for
    /// them. Returns `None` if there are too few arguments.
    fn write_to<S: Scalar>(
        &self,
        pendulum: &Self::On<S>,
        time: S,
        arguments: &[S],
        values: &mut [S],
        put: &mut impl FnMut(usize, S),
    ) -> Option<()>;
}

/// Result of a [`StateFunction`].
pub(super) struct ValuesOf<F, const A: usize>(pub(super) PhantomData<F>);

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
    fn write_to<S: Scalar>(
        &self,
        pendulum: &P::Of<S>,
        time: S,
        arguments: &[S],
        _: &mut [S],
        put: &mut impl FnMut(usize, S),
    ) -> Option<()> {
        F::call::<S>(pendulum, time, arguments)?.write_to(0, put);
        Some(())
    }
}

/// A function `F` of a model with `A` arguments and `R` results.
pub(super) struct Applied<F, const A: usize, const R: usize> {
    pub(super) function: PhantomData<F>,
    /// Index of the sector or of the set of prescribed links.
    pub(super) index: usize,
    /// Number of elements of each argument, followed by those of each result.
    pub(super) given: [usize; A],
    pub(super) results: [usize; R],
}

impl<F, P, T, const A: usize, const R: usize> RegisterFunction<P, T> for Applied<F, A, R>
where
    F: SliceFunction,
    P: Computes<F, T>,
    T: Scalar,
{
    type On<S: Scalar> = P::On<S>;

    #[inline(always)]
    fn on<S: Scalar>(pendulum: &P, convert: impl Fn(T) -> S) -> P::On<S> {
        pendulum.on(convert)
    }

    #[inline(always)]
    fn write_to<S: Scalar>(
        &self,
        pendulum: &P::On<S>,
        time: S,
        arguments: &[S],
        values: &mut [S],
        put: &mut impl FnMut(usize, S),
    ) -> Option<()> {
        let mut rest = arguments;
        let mut given: [&[S]; A] = [&[]; A];
        for (own, size) in given.iter_mut().zip(self.given) {
            (*own, rest) = rest.split_at_checked(size)?;
        }
        let mut results: [&mut [S]; R] = core::array::from_fn(|_| &mut [][..]);
        let mut rest = &mut *values;
        for (own, size) in results.iter_mut().zip(self.results) {
            (*own, rest) = rest.split_at_mut_checked(size)?;
        }
        let index = self.index;
        pendulum.compute(At { time, index }, &given, &mut results);
        for (index, &value) in values.iter().enumerate() {
            put(index, value);
        }
        Some(())
    }
}

/// All states; lengths checked.
pub(super) struct FunctionOfStates<'a, F, P, T, In, Out, const A: usize> {
    pub(super) function: F,
    pub(super) pendulum: &'a P,
    pub(super) time: T,
    pub(super) count: usize,
    pub(super) arguments: [&'a [In]; A],
    pub(super) values: &'a mut [Out],
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

    /// Evaluates the states register by register; if the last register would not be full, it
    /// overlaps the one before.
    #[inline(always)]
    fn run<R: Simd<T>>(self) {
        let pendulum = F::on(self.pendulum, R::splat);
        let time = R::splat(self.time);
        let elements = self.arguments.iter().map(|argument| argument.len()).sum();
        let mut arguments = alloc::vec![R::splat(T::from_f64(0.0)); elements];
        let mut values = alloc::vec![R::splat(T::from_f64(0.0)); self.values.len()];
        // If there are fewer states than lanes.
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
            let function = &self.function;
            let reported =
                function.write_to::<R>(&pendulum, time, &arguments, &mut values, &mut put);
            if reported.is_none() {
                return;
            }
            next = start + R::LANES;
        }
    }
}
