//! Wide numbers: registers, their operations, and the choice of those that the machine supports.
//!
//! [`Lanes`] are arrays, which the compiler splits into single numbers and then combines into
//! registers again. This works well for short functions, but badly and slowly for long ones. The
//! types of this module are registers from the start. The module does not depend on what is
//! computed with them.
//!
//! # How instructions are used only on machines that have them
//! A register, and a number that fuses, *is* the proof that the machine has its instructions:
//! - only [`dispatch`] starts computations with them, once it has the value [`Present`] for these
//!   instructions;
//! - the types are private to this crate, and no item that another crate can name leads to them:
//!   neither a public item nor an associated type of a public trait. Generic functions of other
//!   crates get them as type parameters, in computations that have been started;
//! - [`Simd`] is sealed: other crates cannot declare which lanes a type of theirs consists of.
//!
//! [`Present`]: dispatch::Present

// The traits occur in the interface of public ones, so that they must be `pub`; no other code names
// them.
#![allow(unreachable_pub)]

pub(crate) mod dispatch;
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
mod with_sin_cos;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod x86;

use core::mem::MaybeUninit;

pub use dispatch::{InstructionSet, StateKernel};
#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
pub(crate) use narrow::{F32x4, F64x2};
pub(crate) use one::Fused;
pub use part::{Part, outlined};
pub use quad::Quad;
pub use row::Row;
pub(crate) use with_sin_cos::WithSinCos;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
pub(crate) use x86::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

use crate::scalar::{Real, Scalar};

/// A computation that is compiled for the wide numbers of every instruction set. Code that it calls
/// profits only if it is inlined: write `#[inline(always)]`.
pub trait Kernel<T> {
    /// Result of the computation.
    type Output;

    /// Runs the computation with one kind of wide numbers.
    fn run<V: Simd<T>>(self) -> Self::Output;
}

/// The types that implement [`Simd`]: every number for itself, arrays of lanes, and the registers
/// of this crate.
mod sealed {
    pub trait Sealed<T> {}
}
use sealed::Sealed;

/// A wide number: several numbers `T` in one register, each in its lane. Every number is also a
/// wide number of one lane. Sealed: other crates cannot implement it.
///
/// The wide registers use fused multiply–add; those of the build do not. See [`Scalar::mul_add`].
#[allow(unsafe_code)]
pub trait Simd<T>: Scalar + Sealed<T> {
    /// Number of lanes, at least one.
    const LANES: usize = <Self::Chunk as Row<T>>::LENGTH;

    /// True if a batch of models with few links computes the sines of the next register of states
    /// in advance. This needs many registers, and sines without branches.
    const AHEAD: bool = false;

    /// True if an operation on this type is one operation for each lane.
    const APART: bool = false;

    /// Type of a single lane with the same arithmetic.
    type One: Simd<T>;

    /// Mask that selects lanes.
    type Mask: Copy;

    /// Returns the mask of the lanes whose index `meant` accepts.
    fn mask(meant: impl Fn(usize) -> bool) -> Self::Mask;

    /// Returns this register's numbers in the lanes of `mask`, and those of `other` in the
    /// remaining lanes.
    fn choose(self, other: Self, mask: Self::Mask) -> Self;

    /// Returns this register's numbers in the first `count` lanes, and those of `other` in the
    /// remaining lanes.
    #[inline(always)]
    fn in_first_lanes(self, count: usize, other: Self) -> Self {
        match count < Self::LANES {
            true => self.choose(other, Self::mask(|lane| lane < count)),
            false => self,
        }
    }

    /// Returns, lane by lane, the larger of the two magnitudes. If one number is NaN, the result
    /// may be either of them or their magnitudes.
    fn larger_size(self, other: Self) -> Self
    where
        T: Real;

    /// Returns sines and cosines of all angles, if this type computes them together in advance;
    /// `None` if they are computed when needed, by [`sin_cos_near`](Self::sin_cos_near).
    #[inline(always)]
    fn sin_cos_ahead<const N: usize>(angles: &[Self; N]) -> Option<([Self; N], [Self; N])> {
        Some(Self::sin_cos_each(angles))
    }

    /// Returns sines and cosines of some of the angles for which
    /// [`sin_cos_ahead`](Self::sin_cos_ahead) returned `None`.
    #[inline(always)]
    fn sin_cos_near<const N: usize>(angles: &[Self; N]) -> ([Self; N], [Self; N]) {
        Self::sin_cos_each(angles)
    }

    /// Runs `kernel` in a separate function, which is compiled for the instructions of this number
    /// type.
    #[inline(never)]
    fn in_own_function<K: Kernel<T>>(kernel: K) -> K::Output {
        kernel.run::<Self>()
    }

    /// Returns the same number in every lane.
    fn splat(value: T) -> Self;

    /// Returns the numbers moved towards the first lane: lane `i` gets lane `first + i`. Lanes
    /// without a source have unspecified values.
    fn rotate_lanes(self, first: usize) -> Self;

    /// Returns the first `count` lanes, repeated to fill the register.
    fn tile_lanes(self, count: usize) -> Self;

    /// Reads the numbers at `start`, with the alignment of a `T`.
    ///
    /// # Safety
    /// [`LANES`](Self::LANES) numbers must be readable there.
    #[inline(always)]
    unsafe fn read(start: *const T) -> Self {
        // SAFETY: guaranteed by the caller. A wide number consists of its lanes, except `Lanes`,
        // which overrides this function. The numbers need not have the alignment of a register.
        unsafe { start.cast::<Self>().read_unaligned() }
    }

    /// Writes the numbers to `start`.
    ///
    /// # Safety
    /// [`LANES`](Self::LANES) numbers must be writable there.
    #[inline(always)]
    unsafe fn write(self, start: *mut T) {
        // SAFETY: as in `read`.
        unsafe { start.cast::<Self>().write_unaligned(self) }
    }

    /// Writes the first `count` numbers to `start`, at most all of them.
    ///
    /// # Safety
    /// That number of values must be writable there.
    #[inline(always)]
    unsafe fn write_some(self, start: *mut T, count: usize)
    where
        T: Copy,
    {
        let numbers = self.to_chunk();
        // A loop over all lanes, so that the compiler does not call a copying function.
        for (lane, &number) in numbers.as_ref().iter().enumerate() {
            if lane < count {
                // SAFETY: guaranteed by the caller.
                unsafe { start.add(lane).write(number) }
            }
        }
    }

    /// Reads numbers from the beginning of a slice; `None` if it is too short.
    #[inline(always)]
    fn load(numbers: &[T]) -> Option<Self> {
        Self::Chunk::first_of(numbers).map(Self::from_chunk)
    }

    /// Reads numbers from the beginning of a slice, and zeros beyond its end.
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

    /// Writes the numbers to the beginning of a slice. A slice that is too short is left unchanged.
    #[inline(always)]
    fn store(self, numbers: &mut [T]) {
        if numbers.len() >= Self::LANES {
            // SAFETY: the slice has at least that many elements.
            unsafe { self.write(numbers.as_mut_ptr()) }
        }
    }

    /// Writes the numbers to the end of a slice. A slice that is too short is left unchanged.
    #[inline(always)]
    fn store_last(self, numbers: &mut [T]) {
        let first = numbers.len().wrapping_sub(Self::LANES);
        self.store(numbers.get_mut(first..).unwrap_or_default());
    }

    /// Reads the wide number with the given index from `quads`; the wide number must have four
    /// lanes or one.
    #[inline(always)]
    fn load_quad(quads: &[Quad<T>], index: usize) -> Self {
        const { assert!(4 % Self::LANES == 0) }
        let first = index * Self::LANES;
        match Self::load(&quads[first / 4].0[first % 4..]) {
            Some(numbers) => numbers,
            // The length is asserted, so this case does not occur.
            None => Self::from_f64(f64::NAN),
        }
    }

    /// Writes the wide number that [`load_quad`](Self::load_quad) reads.
    #[inline(always)]
    fn store_quad(self, quads: &mut [Quad<T>], index: usize) {
        let first = index * Self::LANES;
        self.store(&mut quads[first / 4].0[first % 4..]);
    }

    /// Returns `self` + a b, rounded as [`mul_add`](Scalar::mul_add) does.
    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        a.mul_add(b, self)
    }

    /// Returns `self` − a b, rounded as [`mul_add`](Scalar::mul_add) does.
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        (-a).mul_add(b, self)
    }

    /// Array that holds the numbers of all lanes, as in memory.
    type Chunk: Row<T>;

    /// Returns the last [`LANES`](Self::LANES) numbers of a slice, or `None` if it is too short.
    #[inline(always)]
    fn last_chunk(numbers: &[T]) -> Option<&Self::Chunk> {
        Self::Chunk::last_of(numbers)
    }

    /// Creates a wide number from an array.
    #[inline(always)]
    fn from_chunk(numbers: &Self::Chunk) -> Self {
        // SAFETY: a chunk holds exactly `LANES` numbers.
        unsafe { Self::read(core::ptr::from_ref(numbers).cast()) }
    }

    /// Returns the numbers of all lanes, in order.
    #[inline(always)]
    fn to_chunk(self) -> Self::Chunk {
        let mut chunk = MaybeUninit::<Self::Chunk>::uninit();
        // SAFETY: a chunk consists of exactly `LANES` numbers.
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

/// Number of lanes of the widest register.
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
        // The length is asserted, so this case does not occur.
        None => V::from_f64(f64::NAN),
    }
}

/// Views a slice of plain numbers as wide numbers, beginning at the first aligned position. Returns
/// `None` for types whose memory does not consist of lanes only.
#[allow(unsafe_code)]
pub(crate) fn wide_slice<T: Scalar, V: Simd<T>>(numbers: &mut [T]) -> Option<&mut [V]> {
    if size_of::<V>() != V::LANES * size_of::<T>() {
        return None;
    }
    // SAFETY: a wide number consists of its lanes only, as its size shows, and every value of a
    // lane is valid.
    Some(unsafe { numbers.align_to_mut().1 })
}

/// Returns true if a `V` consists of exactly one `T`, with the same alignment.
const fn is_one<T, V: Simd<T>>() -> bool {
    V::LANES == 1 && size_of::<V>() == size_of::<T>() && align_of::<V>() <= align_of::<T>()
}

/// Views a slice of plain numbers as numbers of one lane; `None` for types that are larger than
/// that lane.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn one_slice<T, V: Simd<T>>(numbers: &[T]) -> Option<&[V]> {
    if !const { is_one::<T, V>() } {
        return None;
    }
    // SAFETY: each element is one such number, by its lanes, its size and its alignment.
    Some(unsafe { core::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) })
}

/// Views a mutable slice of plain numbers as numbers of one lane; `None` for types that are larger
/// than that lane.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn one_slice_mut<T, V: Simd<T>>(numbers: &mut [T]) -> Option<&mut [V]> {
    if !const { is_one::<T, V>() } {
        return None;
    }
    // SAFETY: as above, and every value of one type is valid for the other.
    Some(unsafe { core::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), numbers.len()) })
}
