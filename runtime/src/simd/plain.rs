//! Wide numbers that are not registers: a number of any type, and arrays.

#![allow(unsafe_code)]

use super::permutation::{rotated, tiled};
use super::{Sealed, Simd};
use crate::scalar::{Lanes, Real, Scalar};

impl<T: Scalar> Sealed<T> for T {}
impl<T: Scalar, const N: usize> Sealed<T> for Lanes<T, N> {}

/// Every number is a wide number of one lane.
impl<T: Scalar> Simd<T> for T {
    type One = T;
    type Mask = bool;
    type Chunk = [T; 1];

    #[inline(always)]
    fn mask(meant: impl Fn(usize) -> bool) -> bool {
        meant(0)
    }

    #[inline(always)]
    fn choose(self, other: Self, mask: bool) -> Self {
        if mask { self } else { other }
    }

    #[inline(always)]
    fn larger_size(self, other: Self) -> Self
    where
        T: Real,
    {
        Real::max(Real::abs(self), Real::abs(other))
    }

    #[inline(always)]
    fn splat(value: T) -> Self {
        value
    }

    #[inline(always)]
    fn rotate_lanes(self, _first: usize) -> Self {
        self
    }

    #[inline(always)]
    fn tile_lanes(self, _count: usize) -> Self {
        self
    }
}

/// Arrays replace registers of instruction sets for which this crate has no type.
impl<T: Scalar, const N: usize> Simd<T> for Lanes<T, N> {
    type One = T;
    type Mask = [bool; N];
    type Chunk = [T; N];

    const APART: bool = true;

    const LANES: usize = {
        assert!(N > 0, "a wide number has at least one lane");
        N
    };

    #[inline(always)]
    fn mask(meant: impl Fn(usize) -> bool) -> [bool; N] {
        core::array::from_fn(meant)
    }

    #[inline(always)]
    fn choose(self, other: Self, mask: [bool; N]) -> Self {
        let mut result = other;
        for (lane, meant) in mask.into_iter().enumerate() {
            if meant {
                result.0[lane] = self.0[lane];
            }
        }
        result
    }

    #[inline(always)]
    fn larger_size(self, other: Self) -> Self
    where
        T: Real,
    {
        let mut result = self;
        for (size, other) in result.0.iter_mut().zip(other.0) {
            *size = Real::max(Real::abs(*size), Real::abs(other));
        }
        result
    }

    #[inline(always)]
    fn splat(value: T) -> Self {
        Lanes::splat(value)
    }

    #[inline(always)]
    unsafe fn read(start: *const T) -> Self {
        // SAFETY: guaranteed by the caller. The numbers need not have the alignment of `Lanes`.
        Lanes(unsafe { start.cast::<[T; N]>().read_unaligned() })
    }

    #[inline(always)]
    unsafe fn write(self, start: *mut T) {
        // SAFETY: guaranteed by the caller. The numbers need not have the alignment of `Lanes`.
        unsafe { start.cast::<[T; N]>().write_unaligned(self.0) }
    }

    #[inline(always)]
    fn rotate_lanes(self, first: usize) -> Self {
        permuted(self, &const { rotated::<N, N>() }[first.min(N - 1)])
    }

    #[inline(always)]
    fn tile_lanes(self, count: usize) -> Self {
        permuted(self, &const { tiled::<N, N>() }[count.clamp(1, N) - 1])
    }
}

#[inline(always)]
fn permuted<T: Copy, const N: usize>(numbers: Lanes<T, N>, lanes: &[u32; N]) -> Lanes<T, N> {
    let mut result = numbers;
    for (number, &lane) in result.0.iter_mut().zip(lanes) {
        *number = numbers.0[lane as usize];
    }
    result
}
