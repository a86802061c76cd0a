//! Evaluation of a function of one state with fused multiply–add.

use core::marker::PhantomData;

use super::model::known;
use super::{At, Computes, SliceFunction};
use crate::scalar::kind::ByKind;
use crate::scalar::{Lane, Scalar};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Simd, one_slice, one_slice_mut};

/// Largest number of links of an unrolled model for which fused multiply–add is used; the code of
/// larger models is compiled in parts.
const MOST_LINKS: usize = 64;

/// Largest number of slices that a function of a state takes, and largest number that it writes.
const MOST_ARGUMENTS: usize = 6;
const MOST_RESULTS: usize = 4;

/// Computes a function with fused multiply–add if the type and the machine support it, otherwise in
/// the arithmetic of `T`.
#[inline(always)]
pub(super) fn in_fused_arithmetic<F: SliceFunction, T: Scalar, M: Computes<F, T>>(
    model: &M,
    at: At<T>,
    given: &[&[T]],
    results: &mut [&mut [T]],
) {
    const { assert!(F::ARGUMENTS <= MOST_ARGUMENTS && F::RESULTS <= MOST_RESULTS) }
    if !const { is_small(known(M::KNOWN_LINKS)) }
        || [given.len(), results.len()] != [F::ARGUMENTS, F::RESULTS]
    {
        return model.compute(at, given, results);
    }
    let mut state = OneState {
        function: PhantomData::<F>,
        model,
        at,
        given: [&[]; MOST_ARGUMENTS],
        results: [&mut [], &mut [], &mut [], &mut []],
    };
    for (own, slice) in state.given.iter_mut().zip(given) {
        *own = slice;
    }
    for (own, slice) in state.results.iter_mut().zip(results) {
        *own = slice;
    }
    T::by_kind(state);
}

const fn is_small(links: usize) -> bool {
    0 < links && links <= MOST_LINKS
}

/// Arguments and results of a function of one state: the function's slices, followed by empty ones.
/// It is passed by value, so that the code for each instruction set knows the number of slices.
struct OneState<'a, F, M, T> {
    function: PhantomData<F>,
    model: &'a M,
    at: At<T>,
    given: [&'a [T]; MOST_ARGUMENTS],
    results: [&'a mut [T]; MOST_RESULTS],
}

impl<F: SliceFunction, T: Scalar, M: Computes<F, T>> ByKind<T> for OneState<'_, F, M, T> {
    type Output = ();

    #[inline(always)]
    fn of_any(mut self) {
        if let (Some(given), Some(results)) = (
            self.given.get(..F::ARGUMENTS),
            self.results.get_mut(..F::RESULTS),
        ) {
            self.model.compute(self.at, given, results);
        }
    }

    #[inline(always)]
    fn of_plain(self)
    where
        T: Lane,
    {
        in_fused_numbers(self);
    }
}

impl<F: SliceFunction, T: Scalar, M: Computes<F, T>> Kernel<T> for OneState<'_, F, M, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let given: [&[V]; MOST_ARGUMENTS] =
            self.given.map(|slice| one_slice(slice).unwrap_or_default());
        let mut results: [&mut [V]; MOST_RESULTS] = self
            .results
            .map(|slice| one_slice_mut(slice).unwrap_or_default());
        if let (Some(given), Some(results)) =
            (given.get(..F::ARGUMENTS), results.get_mut(..F::RESULTS))
        {
            let model = self.model.on(V::splat);
            model.compute(self.at.map(V::splat), given, results);
        }
    }
}
