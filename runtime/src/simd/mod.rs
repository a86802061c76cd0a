//! Ground floor of wide numbers: registers, what they can do, and which of them the
//! machine has.
//!
//! [`Lanes`] are arrays, which the compiler takes apart into numbers and puts
//! together into registers again: well for short functions, badly and slowly for
//! long ones. The types here are registers from the start. Nothing here knows what is
//! computed.
//!
//! # What keeps instructions on machines that have them
//! A register, and a number that fuses, *is* the proof that the machine has its instructions:
//! - [`dispatch`] alone starts computations with them, once it has [`Present`] for these;
//! - the types are this crate's, and nothing that another crate can name leads to them:
//!   neither a public item nor an associated type of a public trait. Generic functions of
//!   others get them as parameters, in computations that have been started;
//! - [`Simd`] is sealed: other crates cannot say of a type of theirs what it consists of.
//!
//! [`Present`]: dispatch::Present

// The traits appear in the interface of public ones, so that they must be `pub`, and
// are named by no one else.
#![allow(unreachable_pub)]

pub(crate) mod dispatch;
mod known;
#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
mod narrow;
mod one;
mod part;
mod permutation;
mod plain;
mod quad;
mod row;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod x86;

use core::mem::MaybeUninit;

pub use dispatch::{InstructionSet, StateKernel};
pub(crate) use known::Known;
#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
pub(crate) use narrow::{F32x4, F64x2};
pub(crate) use one::Fused;
pub use part::{Part, outlined};
pub use quad::Quad;
pub use row::Row;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
pub(crate) use x86::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

use crate::scalar::{Real, Scalar};

/// A computation that is compiled for the wide numbers of every instruction set.
/// Code that it calls profits only as far as it is inlined: write `#[inline(always)]`.
pub trait Kernel<T> {
    /// The result.
    type Output;

    /// Computes with one kind of wide numbers.
    fn run<V: Simd<T>>(self) -> Self::Output;
}

/// The types that [`Simd`] is for: every number for itself, arrays of lanes, and the
/// registers of this crate.
mod sealed {
    pub trait Sealed<T> {}
}
use sealed::Sealed;

/// A wide number: several numbers `T` in one register, each in its lane. Every
/// number is one of itself. Sealed: other crates cannot implement it.
///
/// The wide registers fuse products with sums; those of the build do not. See
/// [`Scalar::mul_add`].
#[allow(unsafe_code)]
pub trait Simd<T>: Scalar + Sealed<T> {
    /// Number of lanes, at least one.
    const LANES: usize = <Self::Chunk as Row<T>>::LENGTH;

    /// A batch of few links computes sines a register of states ahead, which needs
    /// many registers and sines that take no branch.
    const AHEAD: bool = false;

    /// One number of the same arithmetic.
    type One: Simd<T>;

    /// Says of each lane whether it is meant.
    type Mask: Copy;

    /// Returns the mask of the lanes of which `meant` is true.
    fn mask(meant: impl Fn(usize) -> bool) -> Self::Mask;

    /// Returns this register's numbers in the lanes of `mask`, those of `other`
    /// elsewhere.
    fn choose(self, other: Self, mask: Self::Mask) -> Self;

    /// Returns this register's numbers in the first `count` lanes, those of `other` in
    /// the lanes behind, if there are any.
    #[inline(always)]
    fn in_first_lanes(self, count: usize, other: Self) -> Self {
        match count < Self::LANES {
            true => self.choose(other, Self::mask(|lane| lane < count)),
            false => self,
        }
    }

    /// Returns the larger size, lane by lane; any of the two, or either, where one is
    /// no number.
    fn larger_size(self, other: Self) -> Self
    where
        T: Real;

    /// Returns sines and cosines of all angles, if they are computed at once; none if
    /// they are computed when asked for, by [`sin_cos_near`](Self::sin_cos_near).
    #[inline(always)]
    fn sin_cos_ahead<const N: usize>(angles: &[Self; N]) -> Option<([Self; N], [Self; N])> {
        Some(Self::sin_cos_each(angles))
    }

    /// Returns sines and cosines of angles among those of which
    /// [`sin_cos_ahead`](Self::sin_cos_ahead) gave none.
    #[inline(always)]
    fn sin_cos_near<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
        Self::sin_cos_each(angles)
    }

    /// Runs `kernel` in a function of its own, which is compiled for the instructions
    /// that the number stands for.
    #[inline(never)]
    fn in_own_function<K: Kernel<T>>(kernel: K) -> K::Output {
        kernel.run::<Self>()
    }

    /// Returns the same number in every lane.
    fn splat(value: T) -> Self;

    /// Returns the numbers moved forward: lane `i` gets lane `first + i`; what has
    /// none there is left open.
    fn rotate_lanes(self, first: usize) -> Self;

    /// Returns the first `count` lanes over and over.
    fn tile_lanes(self, count: usize) -> Self;

    /// Reads the numbers at `start`, wherever a `T` may lie.
    ///
    /// # Safety
    /// So many numbers may be read there.
    #[inline(always)]
    unsafe fn read(start: *const T) -> Self {
        // SAFETY: the caller's. A wide number is its lanes, but for `Lanes`, which has a
        // function of its own. They need not lie where registers would.
        unsafe { start.cast::<Self>().read_unaligned() }
    }

    /// Writes the numbers to `start`.
    ///
    /// # Safety
    /// So many numbers may be written there.
    #[inline(always)]
    unsafe fn write(self, start: *mut T) {
        // SAFETY: as in `read`.
        unsafe { start.cast::<Self>().write_unaligned(self) }
    }

    /// Writes its first `count` numbers to `start`, or all if these are fewer.
    ///
    /// # Safety
    /// So many numbers may be written there.
    #[inline(always)]
    unsafe fn write_some(self, start: *mut T, count: usize)
    where
        T: Copy,
    {
        let numbers = self.to_chunk();
        // Over all lanes, so that compilers do not call a function that copies.
        for (lane, &number) in numbers.as_ref().iter().enumerate() {
            if lane < count {
                // SAFETY: the caller's.
                unsafe { start.add(lane).write(number) }
            }
        }
    }

    /// Reads the first numbers of a slice, if it has enough.
    #[inline(always)]
    fn load(numbers: &[T]) -> Option<Self> {
        Self::Chunk::first_of(numbers).map(Self::from_chunk)
    }

    /// Reads the first numbers of a slice, and zeros behind its end.
    #[inline(always)]
    fn load_front(numbers: &[T]) -> Self
    where
        T: Scalar,
    {
        match Self::load(numbers) {
            Some(front) => front,
            None => load_few(numbers),
        }
    }

    /// Writes the numbers to the front of a slice. A slice too short gets none.
    #[inline(always)]
    fn store(self, numbers: &mut [T]) {
        if numbers.len() >= Self::LANES {
            // SAFETY: there are places for so many.
            unsafe { self.write(numbers.as_mut_ptr()) }
        }
    }

    /// Writes the numbers to the end of a slice. A slice too short gets none.
    #[inline(always)]
    fn store_last(self, numbers: &mut [T]) {
        let first = numbers.len().wrapping_sub(Self::LANES);
        self.store(numbers.get_mut(first..).unwrap_or_default());
    }

    /// Reads wide number `index` of those in `quads`, of which each has four or one.
    #[inline(always)]
    fn load_quad(quads: &[Quad<T>], index: usize) -> Self {
        const { assert!(4 % Self::LANES == 0) }
        let first = index * Self::LANES;
        match Self::load(&quads[first / 4].0[first % 4..]) {
            Some(numbers) => numbers,
            // There are so many: asserted.
            None => Self::from_f64(f64::NAN),
        }
    }

    /// Writes what [`load_quad`](Self::load_quad) reads.
    #[inline(always)]
    fn store_quad(self, quads: &mut [Quad<T>], index: usize) {
        let first = index * Self::LANES;
        self.store(&mut quads[first / 4].0[first % 4..]);
    }

    /// `self` + a b, rounded as [`mul_add`](Scalar::mul_add) does.
    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        a.mul_add(b, self)
    }

    /// `self` − a b, rounded as [`mul_add`](Scalar::mul_add) does.
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        (-a).mul_add(b, self)
    }

    /// The numbers as they lie in memory: an array of so many.
    type Chunk: Row<T>;

    /// Returns the last numbers of a slice, if it has enough.
    #[inline(always)]
    fn last_chunk(numbers: &[T]) -> Option<&Self::Chunk> {
        Self::Chunk::last_of(numbers)
    }

    /// Reads numbers.
    #[inline(always)]
    fn from_chunk(numbers: &Self::Chunk) -> Self {
        // SAFETY: a chunk holds so many numbers.
        unsafe { Self::read(core::ptr::from_ref(numbers).cast()) }
    }

    /// Returns the numbers in their order.
    #[inline(always)]
    fn to_chunk(self) -> Self::Chunk {
        let mut chunk = MaybeUninit::<Self::Chunk>::uninit();
        // SAFETY: a chunk has places for so many numbers, and consists of nothing else.
        unsafe {
            self.write(chunk.as_mut_ptr().cast());
            chunk.assume_init()
        }
    }

    /// Returns the number in the first lane.
    #[inline(always)]
    fn first(self) -> T
    where
        T: Copy,
    {
        const { assert!(Self::LANES > 0) }
        self.to_chunk().as_ref()[0]
    }
}

/// Numbers in the widest register.
pub(crate) const WIDEST: usize = 16;

#[cold]
#[inline(never)]
fn load_few<T: Scalar, V: Simd<T>>(few: &[T]) -> V {
    const { assert!(V::LANES <= WIDEST) }
    let mut numbers = [T::from_f64(0.0); WIDEST];
    for (number, &value) in numbers.iter_mut().zip(few) {
        *number = value;
    }
    match V::load(&numbers) {
        Some(front) => front,
        // There are enough numbers: asserted.
        None => V::from_f64(f64::NAN),
    }
}

/// Returns memory of plain numbers as wide ones, from where the first one would lie;
/// none of a type that is not its numbers alone.
#[allow(unsafe_code)]
pub(crate) fn wide_slice<T: Scalar, V: Simd<T>>(numbers: &mut [T]) -> Option<&mut [V]> {
    if size_of::<V>() != V::LANES * size_of::<T>() {
        return None;
    }
    // SAFETY: a wide number is its lanes, and no more by its size; any numbers are lanes.
    Some(unsafe { numbers.align_to_mut().1 })
}

/// Returns true if a number `V` is one `T` and nothing else, wherever that may lie.
const fn is_one<T, V: Simd<T>>() -> bool {
    V::LANES == 1 && size_of::<V>() == size_of::<T>() && align_of::<V>() <= align_of::<T>()
}

/// Returns plain numbers as numbers of one lane; none of a type that is more than that lane.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn one_slice<T, V: Simd<T>>(numbers: &[T]) -> Option<&[V]> {
    if !const { is_one::<T, V>() } {
        return None;
    }
    // SAFETY: each is one such number, by its lanes, its size and its alignment.
    Some(unsafe { core::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) })
}

/// Does so with memory that is written to.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn one_slice_mut<T, V: Simd<T>>(numbers: &mut [T]) -> Option<&mut [V]> {
    if !const { is_one::<T, V>() } {
        return None;
    }
    // SAFETY: as above, and any number of one kind is one of the other.
    Some(unsafe { core::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), numbers.len()) })
}
