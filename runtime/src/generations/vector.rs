//! Neighbours in a slice, as many as fit a register.

use core::slice::from_raw_parts_mut;

use crate::scalar::{Lane, Lanes, Scalar};

/// Several consecutive numbers of a slice of `T`, computed in step; a plain
/// number is a vector of one.
#[allow(unsafe_code)]
pub trait Vector<T>: Scalar {
    /// How many numbers it holds.
    const LANES: usize;

    /// The numbers from `slice[at]` on; zeros behind its end.
    fn load(slice: &[T], at: usize) -> Self;

    /// Writes the numbers from `slice[at]` on, as many as it has places.
    fn store(self, slice: &mut [T], at: usize);

    /// The numbers at `start`.
    ///
    /// # Safety
    /// So many numbers may be read there.
    unsafe fn read(start: *const T) -> Self;

    /// Writes the numbers to `start`.
    ///
    /// # Safety
    /// So many numbers may be written there.
    unsafe fn write(self, start: *mut T);

    /// Writes its first `count` numbers to `start`, of which it has more.
    ///
    /// # Safety
    /// So many numbers may be written there.
    unsafe fn write_some(self, start: *mut T, count: usize);

    /// The same number in every lane.
    fn splat(value: T) -> Self;

    /// Lane `i` is lane `first + i` of this one; what has none there is left
    /// open.
    fn behind(self, first: usize) -> Self;

    /// The first `count` lanes over and over.
    fn repeat(self, count: usize) -> Self;
}

/// Where each word of a register comes from for [`Vector::behind`], for each lane
/// that may be the first; a lane has `WORDS / N` words.
pub(crate) const fn words_behind<const N: usize, const WORDS: usize>() -> [[u32; WORDS]; N] {
    let mut table = [[0; WORDS]; N];
    let mut i = 0;
    while i < N * WORDS {
        let (first, word) = (i / WORDS, i % WORDS);
        table[first][word] = ((word + first * (WORDS / N)) % WORDS) as u32;
        i += 1;
    }
    table
}

/// The same for [`Vector::repeat`], for each count less one.
pub(crate) const fn words_repeated<const N: usize, const WORDS: usize>() -> [[u32; WORDS]; N] {
    let mut table = [[0; WORDS]; N];
    let mut i = 0;
    while i < N * WORDS {
        let (count, word) = (i / WORDS + 1, i % WORDS);
        table[count - 1][word] = (word % (count * (WORDS / N))) as u32;
        i += 1;
    }
    table
}

/// The numbers from `slice[at]` on, and zeros behind its end: for the last ones
/// of a state.
#[cold]
#[inline(never)]
pub(crate) fn last<T: Scalar, const N: usize>(slice: &[T], at: usize) -> [T; N] {
    let mut numbers = [T::from_f64(0.0); N];
    let rest = slice.get(at..).unwrap_or_default();
    for (number, value) in numbers.iter_mut().zip(rest) {
        *number = *value;
    }
    numbers
}

/// Writes to `slice[at]` and on what fits there.
#[cold]
#[inline(never)]
pub(crate) fn store_last<T: Copy, const N: usize>(numbers: &[T; N], slice: &mut [T], at: usize) {
    let rest = slice.get_mut(at..).unwrap_or_default();
    for (place, number) in rest.iter_mut().zip(numbers) {
        *place = *number;
    }
}

#[allow(unsafe_code)]
impl<T: Scalar> Vector<T> for T {
    const LANES: usize = 1;

    #[inline(always)]
    fn load(slice: &[T], at: usize) -> Self {
        match slice.get(at) {
            Some(&value) => value,
            None => T::from_f64(0.0),
        }
    }

    #[inline(always)]
    fn store(self, slice: &mut [T], at: usize) {
        if let Some(place) = slice.get_mut(at) {
            *place = self;
        }
    }

    #[inline(always)]
    unsafe fn read(start: *const T) -> Self {
        // SAFETY: the caller's.
        unsafe { start.read() }
    }

    #[inline(always)]
    unsafe fn write(self, start: *mut T) {
        // SAFETY: likewise.
        unsafe { start.write(self) }
    }

    #[inline(always)]
    unsafe fn write_some(self, _start: *mut T, _count: usize) {}

    #[inline(always)]
    fn splat(value: T) -> Self {
        value
    }

    #[inline(always)]
    fn behind(self, _first: usize) -> Self {
        self
    }

    #[inline(always)]
    fn repeat(self, _count: usize) -> Self {
        self
    }
}

#[allow(unsafe_code)]
impl<T: Lane, const N: usize> Vector<T> for Lanes<T, N> {
    const LANES: usize = N;

    #[inline(always)]
    fn load(slice: &[T], at: usize) -> Self {
        match slice.get(at..).and_then(|rest| rest.first_chunk()) {
            Some(numbers) => Lanes(*numbers),
            None => Lanes(last(slice, at)),
        }
    }

    #[inline(always)]
    fn store(self, slice: &mut [T], at: usize) {
        match slice.get_mut(at..).and_then(|rest| rest.first_chunk_mut()) {
            Some(place) => *place = self.0,
            None => store_last(&self.0, slice, at),
        }
    }

    #[inline(always)]
    unsafe fn read(start: *const T) -> Self {
        // SAFETY: the caller's. Numbers need not lie where lanes would.
        Lanes(unsafe { start.cast::<[T; N]>().read_unaligned() })
    }

    #[inline(always)]
    unsafe fn write(self, start: *mut T) {
        // SAFETY: likewise.
        unsafe { start.cast::<[T; N]>().write_unaligned(self.0) }
    }

    #[inline(always)]
    unsafe fn write_some(self, start: *mut T, count: usize) {
        // SAFETY: likewise.
        store_last(&self.0, unsafe { from_raw_parts_mut(start, count) }, 0);
    }

    #[inline(always)]
    fn splat(value: T) -> Self {
        Lanes::splat(value)
    }

    #[inline(always)]
    fn behind(self, first: usize) -> Self {
        permuted(self, &const { words_behind::<N, N>() }[first.min(N - 1)])
    }

    #[inline(always)]
    fn repeat(self, count: usize) -> Self {
        permuted(
            self,
            &const { words_repeated::<N, N>() }[count.clamp(1, N) - 1],
        )
    }
}

#[inline(always)]
fn permuted<T: Lane, const N: usize>(numbers: Lanes<T, N>, lanes: &[u32; N]) -> Lanes<T, N> {
    let mut result = numbers;
    for (number, &lane) in result.0.iter_mut().zip(lanes) {
        *number = numbers.0[lane as usize];
    }
    result
}

/// The vectors that slices of `T` are computed in.
pub trait Vectors<T>: 'static {
    /// Neighbours.
    type Wide: Vector<T>;
    /// Neighbours in equations, which are compiled for every model: one, where
    /// more gain little.
    type Long: Vector<T>;
    /// One number.
    type One: Vector<T>;
}

/// Numbers one by one.
#[derive(Clone, Copy, Debug)]
pub struct Single;

impl<T: Scalar> Vectors<T> for Single {
    type Wide = T;
    type Long = T;
    type One = T;
}

/// A computation over slices that is compiled for several vectors.
pub trait SliceKernel<T> {
    /// Computes in the given vectors.
    fn run<W: Vectors<T>>(self);
}

/// What is done to neighbours from an index on, as many as a vector holds.
pub(super) trait Step<V> {
    /// None where something is missing, which ends the steps.
    fn at(&mut self, index: usize) -> Option<()>;
}

/// Takes a step over all indices below `count`. Where vectors do not divide
/// them, the last vector overlaps the one before: a step must give the same
/// result when it is taken twice. Fewer than a vector holds are one step, whose
/// other lanes mean nothing.
#[inline(always)]
pub(super) fn each<T, V: Vector<T>>(count: usize, step: &mut impl Step<V>) -> Option<()> {
    let last = count.saturating_sub(V::LANES);
    let mut index = 0;
    while index < count {
        step.at(index.min(last))?;
        index += V::LANES;
    }
    Some(())
}
