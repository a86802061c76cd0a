//! One state in fused arithmetic, whatever the function.

use core::marker::PhantomData;

use super::{At, Computes};
use crate::scalar::kind::ByKind;
use crate::scalar::{Lane, Scalar};
use crate::simd::dispatch::in_fused_numbers;
use crate::simd::{Kernel, Simd, wide_slice, wide_slice_mut};

/// Most links of a model that is written out and computed so: code of larger ones is compiled
/// in parts.
const MOST_LINKS: usize = 64;

/// Most slices that a function takes, and most that it writes.
const MOST_GIVEN: usize = 6;
const MOST_RESULTS: usize = 2;

/// Computes a function in fused arithmetic where the type and the machine have it, else in
/// that of `T`.
#[inline(always)]
pub(super) fn in_fused_arithmetic<F, T: Scalar, M: Computes<F, T>>(
    model: &M,
    at: At<T>,
    given: &[&[T]],
    results: &mut [&mut [T]],
) {
    let is_small = matches!(M::KNOWN_LINKS, Some(..=MOST_LINKS));
    if !is_small || given.len() > MOST_GIVEN || results.len() > MOST_RESULTS {
        return model.compute(at, given, results);
    }
    T::by_kind(OneState {
        function: PhantomData::<F>,
        model,
        at,
        given,
        results,
    });
}

/// A state of a model, and where the results go.
struct OneState<'a, 's, 'r, F, M, T> {
    function: PhantomData<F>,
    model: &'a M,
    at: At<T>,
    given: &'a [&'s [T]],
    results: &'a mut [&'r mut [T]],
}

impl<F, T: Scalar, M: Computes<F, T>> ByKind<T> for OneState<'_, '_, '_, F, M, T> {
    type Output = ();

    #[inline(always)]
    fn of_any(self) {
        self.model.compute(self.at, self.given, self.results);
    }

    #[inline(always)]
    fn of_plain(self)
    where
        T: Lane,
    {
        in_fused_numbers(self);
    }
}

impl<F, T: Scalar, M: Computes<F, T>> Kernel<T> for OneState<'_, '_, '_, F, M, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd<T>>(self) {
        let Self {
            model,
            at,
            given,
            results,
            ..
        } = self;
        let mut wide: [&[V]; MOST_GIVEN] = [&[]; MOST_GIVEN];
        let mut wide_results: [&mut [V]; MOST_RESULTS] =
            core::array::from_fn(|_| <&mut [V]>::default());
        let counts = (given.len(), results.len());
        for (wide, slice) in wide.iter_mut().zip(given) {
            *wide = wide_slice(slice).unwrap_or_default();
        }
        for (wide, slice) in wide_results.iter_mut().zip(results) {
            *wide = wide_slice_mut(slice).unwrap_or_default();
        }
        if let (Some(given), Some(results)) =
            (wide.get(..counts.0), wide_results.get_mut(..counts.1))
        {
            model.on(V::splat).compute(at.map(V::splat), given, results);
        }
    }
}
