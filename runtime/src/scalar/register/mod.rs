//! Vector registers as numbers.
//!
//! [`Lanes`](super::Lanes) are arrays, which the compiler takes apart into
//! numbers and puts together into registers again: well for short functions,
//! badly and slowly for long ones. The types here are registers from the start.
//! They exist inside computations that [`dispatch`](super::dispatch) starts, and
//! nowhere else: no public function returns one.

// The types appear in the interface of a sealed trait, so that they must be
// `pub`, and can be reached by no one.
#![allow(unreachable_pub)]

mod block;
mod known;
mod one;
#[cfg(target_arch = "x86_64")]
mod x86;

pub(crate) use block::Block;
pub(crate) use known::Known;
pub use one::Fused;
#[cfg(target_arch = "x86_64")]
pub use x86::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

use super::{Lane, Lanes, Scalar};
use crate::generations::{Vectors, With};

/// Several numbers in one register, each in its lane.
///
/// The wide ones fuse products with sums; the ones of the build do not. See
/// [`Scalar::mul_add`].
pub trait Register: Scalar {
    /// A number in it.
    type Lane: Lane;

    /// How many.
    const LANES: usize;

    /// This register, and narrower ones for fewer numbers.
    type Vectors: Vectors<Self::Lane>;

    /// Whether a batch of few links computes sines a register of states ahead, which
    /// needs many registers and sines that take no branch.
    const AHEAD: bool = false;

    /// Says of each lane whether it is meant.
    type Mask: Copy;

    /// The mask of the lanes of which `meant` is true.
    fn mask(meant: impl Fn(usize) -> bool) -> Self::Mask;

    /// This register's numbers in the lanes of `mask`, those of `other` elsewhere.
    fn choose(self, other: Self, mask: Self::Mask) -> Self;

    /// The larger size, lane by lane; any of the two, or either, where one is no
    /// number.
    fn larger_size(self, other: Self) -> Self;

    /// Sines and cosines of `M` blocks: the same values as
    /// [`Scalar::sin_cos_each`].
    #[inline(always)]
    fn sin_cos_blocks<const N: usize, const M: usize>(
        angles: &[[Self; N]; M],
    ) -> ([[Self; N]; M], [[Self; N]; M]) {
        let zero = [[Self::from_f64(0.0); N]; M];
        let (mut sines, mut cosines) = (zero, zero);
        for j in 0..M {
            (sines[j], cosines[j]) = Self::sin_cos_each(&angles[j]);
        }
        (sines, cosines)
    }

    /// The same number in every lane.
    fn splat(value: Self::Lane) -> Self;

    /// The first numbers of a slice, if it has enough.
    fn load(numbers: &[Self::Lane]) -> Option<Self>;

    /// Writes the numbers to the front of a slice. A slice too short gets none.
    fn store(self, numbers: &mut [Self::Lane]);

    /// Its numbers where they lie in memory.
    type Chunk;

    /// The last numbers of a slice, if it has enough.
    fn last_chunk(numbers: &[Self::Lane]) -> Option<&Self::Chunk>;

    /// Reads numbers.
    fn from_chunk(numbers: &Self::Chunk) -> Self;

    /// The numbers in their order.
    fn to_chunk(self) -> Self::Chunk;

    /// Writes the numbers to the end of a slice. A slice too short gets none.
    fn store_last(self, numbers: &mut [Self::Lane]);
}

/// The registers of instruction sets that this crate has no type for.
impl<T: Lane, const N: usize> Register for Lanes<T, N> {
    type Lane = T;
    type Vectors = With<Self>;
    type Mask = [bool; N];
    type Chunk = [T; N];

    const LANES: usize = N;

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
    fn larger_size(self, other: Self) -> Self {
        let mut result = self;
        for (size, other) in result.0.iter_mut().zip(other.0) {
            *size = size.abs().max(other.abs());
        }
        result
    }

    #[inline(always)]
    fn splat(value: T) -> Self {
        Lanes::splat(value)
    }

    #[inline(always)]
    fn load(numbers: &[T]) -> Option<Self> {
        numbers.first_chunk().copied().map(Self)
    }

    #[inline(always)]
    fn store(self, numbers: &mut [T]) {
        if let Some(front) = numbers.first_chunk_mut() {
            *front = self.0;
        }
    }

    #[inline(always)]
    fn last_chunk(numbers: &[T]) -> Option<&[T; N]> {
        numbers.last_chunk()
    }

    #[inline(always)]
    fn from_chunk(numbers: &[T; N]) -> Self {
        Self(*numbers)
    }

    #[inline(always)]
    fn to_chunk(self) -> [T; N] {
        self.0
    }

    #[inline(always)]
    fn store_last(self, numbers: &mut [T]) {
        if let Some(back) = numbers.last_chunk_mut() {
            *back = self.0;
        }
    }
}
