//! Columns of numbers, equally long, that are read and written at one place.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::equations::Row;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// Numbers of a slice as `N` columns, or some rows of these. [`Rows`] of numbers have some
/// of them too.
///
/// As slices of their own, each column would ask whether a place lies in it, every
/// time: many questions with one respond, and more instructions than the mechanics.
/// Copies are views of the same numbers, as of a slice of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Columns<'a, T, const N: usize> {
    start: *mut T,
    /// From one column to the next, and from one row to the next.
    stride: usize,
    row: usize,
    rows: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<'a, T: Copy, const N: usize> Columns<'a, T, N> {
    /// The front of a slice as columns of `length` numbers, or of fewer where it is
    /// too short.
    #[inline(always)]
    pub(super) fn new(slice: &'a mut [T], length: usize) -> Self {
        let length = length.min(slice.len() / N.max(1));
        Self {
            start: slice.as_mut_ptr(),
            stride: length,
            row: 1,
            rows: length,
            slice: PhantomData,
        }
    }

    /// The rows from `at` on, as many as said: where one number is the length of
    /// several windows, one question is enough for all.
    #[inline(always)]
    pub(super) fn window(self, at: usize, rows: usize) -> Option<Self> {
        if rows > self.rows || at > self.rows - rows {
            return None;
        }
        Some(Self {
            start: self.start.wrapping_add(at * self.row),
            rows,
            ..self
        })
    }

    /// Where the first one starts.
    pub(super) fn start(self) -> *mut T {
        self.start
    }

    /// From one to the next.
    pub(super) fn stride(self) -> usize {
        self.stride
    }

    #[inline(always)]
    fn has<V: Simd<T>>(self, at: usize) -> bool {
        // Of rows, the numbers of several links do not stand side by side.
        let side_by_side = V::LANES == 1 || self.row == 1;
        side_by_side && V::LANES <= self.rows && at <= self.rows - V::LANES
    }

    fn cells(self) -> Cells<T> {
        Cells {
            start: self.start,
            row: self.row,
            stride: self.stride,
        }
    }

    /// Returns the vectors at `at`; none where they would cross the end.
    #[inline(always)]
    pub(super) fn load<V: Simd<T>>(self, at: usize) -> Option<[V; N]> {
        if !self.has::<V>(at) {
            return None;
        }
        // SAFETY: as in `store`; what is read there is copied at once.
        Some(unsafe { self.cells().read(at) })
    }

    /// Writes the vectors at `at` of the first `M` columns; none where they would
    /// cross the end.
    #[inline(always)]
    pub(super) fn store<V: Simd<T>, const M: usize>(
        self,
        at: usize,
        vectors: &[V; M],
    ) -> Option<()> {
        const { assert!(M <= N, "there are not so many columns") };
        if !self.has::<V>(at) {
            return None;
        }
        // SAFETY: in the slice there are `N` columns, `stride` apart, of which each has
        // `rows` numbers from `start` on, `row` apart; by `new` and `Rows::columns`, and kept
        // by `window`. `has` has seen that `LANES` from `at` on are among them. The slice is
        // borrowed mutably for as long as the views live, which are all in one thread, and no
        // other reference is there now.
        unsafe { self.cells().write(at, vectors) };
        Some(())
    }
}

/// Numbers of a slice in rows, one behind the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows<'a, T> {
    start: *mut T,
    width: usize,
    rows: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<'a, T> Rows<'a, T> {
    /// The front of a slice in rows of `width` numbers.
    #[inline(always)]
    pub(super) fn new(slice: &'a mut [T], width: usize) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            width,
            rows: slice.len() / width.max(1),
            slice: PhantomData,
        }
    }

    /// `N` columns, from number `first` of each row on; none where a row has not so many.
    #[inline(always)]
    pub(super) fn columns<const N: usize>(self, first: usize) -> Columns<'a, T, N> {
        let fit = first + N <= self.width;
        Columns {
            start: self.start.wrapping_add(first),
            stride: 1,
            row: self.width,
            rows: if fit { self.rows } else { 0 },
            slice: PhantomData,
        }
    }
}

/// Where the numbers of links stand: number `i` of link `at` is at `at · row +
/// i · stride`. In columns, links are side by side; in rows, the numbers of a link are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells<T> {
    start: *mut T,
    row: usize,
    stride: usize,
}

impl<T: Copy> Cells<T> {
    /// In columns, so far apart.
    #[inline(always)]
    pub(super) fn columns(start: *mut T, stride: usize) -> Self {
        Self {
            start,
            row: 1,
            stride,
        }
    }

    /// In rows of so many numbers.
    #[inline(always)]
    pub(super) fn rows(start: *mut T, row: usize) -> Self {
        Self {
            start,
            row,
            stride: 1,
        }
    }

    /// The links from `at` on.
    #[inline(always)]
    pub(super) fn from(self, at: usize) -> Self {
        Self {
            start: self.start.wrapping_add(at * self.row),
            ..self
        }
    }

    /// Where number `i` of the link `at` stands.
    #[inline(always)]
    pub(super) fn place(self, at: usize, i: usize) -> *mut T {
        self.start.wrapping_add(at * self.row + i * self.stride)
    }

    /// Reads numbers of the link `at`, or of as many links as `V` has lanes.
    ///
    /// # Safety
    /// The numbers may be read there.
    // A plain loop: iterators are many lines to compile, with each model.
    #[inline(always)]
    pub(super) unsafe fn read<V: Simd<T>, A: Row<V>>(self, at: usize) -> A {
        let start = self.from(at).start;
        let mut vectors = A::filled(V::from_f64(0.0));
        let mut i = 0;
        while i < A::LENGTH {
            // SAFETY: the caller's.
            vectors.as_mut()[i] = unsafe { V::read(start.add(i * self.stride)) };
            i += 1;
        }
        vectors
    }

    /// Writes numbers of the link `at`, or of as many links as `V` has lanes.
    ///
    /// # Safety
    /// The numbers may be written there.
    #[inline(always)]
    pub(super) unsafe fn write<V: Simd<T>, A: Row<V>>(self, at: usize, vectors: &A) {
        let start = self.from(at).start;
        let mut i = 0;
        while i < A::LENGTH {
            // SAFETY: the caller's.
            unsafe { vectors.as_ref()[i].write(start.add(i * self.stride)) };
            i += 1;
        }
    }
}

/// The numbers from a place where there are enough; NaN elsewhere.
#[inline(always)]
pub(super) fn load<T: Scalar, V: Simd<T>>(numbers: &[T], place: usize) -> V {
    match V::load(numbers.get(place..).unwrap_or_default()) {
        Some(row) => row,
        None => V::from_f64(f64::NAN),
    }
}

/// The numbers from a place on, and zeros behind the end.
#[inline(always)]
pub(super) fn load_front<T: Scalar, V: Simd<T>>(numbers: &[T], place: usize) -> V {
    V::load_front(numbers.get(place..).unwrap_or_default())
}
