//! One state in fused arithmetic, whatever the function.

use core::marker::PhantomData;

use super::model::known;
use super::{At, Computes, SliceCounts};
use crate::scalar::kind::ByKind;
use crate::scalar::{Lane, Scalar};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Simd, one_slice, one_slice_mut};

/// Most links of a model that is written out and computed so: code of larger ones is compiled
/// in parts.
const MOST_LINKS: usize = 64;

/// Most slices that a function takes, and most that it writes.
const MOST_GIVEN: usize = 6;
const MOST_RESULTS: usize = 2;

/// Computes a function in fused arithmetic where the type and the machine have it, else in
/// that of `T`.
#[inline(always)]
pub(super) fn in_fused_arithmetic<F: SliceCounts, T: Scalar, M: Computes<F, T>>(
    model: &M,
    at: At<T>,
    given: &[&[T]],
    results: &mut [&mut [T]],
) {
    const { assert!(F::GIVEN <= MOST_GIVEN && F::RESULTS <= MOST_RESULTS) }
    if !const { is_small(known(M::KNOWN_LINKS)) }
        || [given.len(), results.len()] != [F::GIVEN, F::RESULTS]
    {
        return model.compute(at, given, results);
    }
    let mut state = OneState {
        function: PhantomData::<F>,
        model,
        at,
        given: [&[]; MOST_GIVEN],
        results: [&mut [], &mut []],
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

/// A state of a model, and where the results go: as many slices as the function has, none
/// behind them. By value, so that the code of each instruction set knows how many there are.
struct OneState<'a, F, M, T> {
    function: PhantomData<F>,
    model: &'a M,
    at: At<T>,
    given: [&'a [T]; MOST_GIVEN],
    results: [&'a mut [T]; MOST_RESULTS],
}

impl<F: SliceCounts, T: Scalar, M: Computes<F, T>> ByKind<T> for OneState<'_, F, M, T> {
    type Output = ();

    #[inline(always)]
    fn of_any(mut self) {
        if let (Some(given), Some(results)) = (
            self.given.get(..F::GIVEN),
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

impl<F: SliceCounts, T: Scalar, M: Computes<F, T>> Kernel<T> for OneState<'_, F, M, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let given: [&[V]; MOST_GIVEN] =
            self.given.map(|slice| one_slice(slice).unwrap_or_default());
        let mut results: [&mut [V]; MOST_RESULTS] = self
            .results
            .map(|slice| one_slice_mut(slice).unwrap_or_default());
        if let (Some(given), Some(results)) = (given.get(..F::GIVEN), results.get_mut(..F::RESULTS))
        {
            let model = self.model.on(V::splat);
            model.compute(self.at.map(V::splat), given, results);
        }
    }
}
