//! Columns of numbers, equally long, that are read and written at one place.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::vector::Vector;

/// Numbers of a slice as `N` columns, or some rows of these.
///
/// As slices of their own, each column would ask whether a place lies in it, every
/// time: many questions with one answer, and more instructions than the mechanics.
/// Copies are views of the same numbers, as of a slice of cells.
#[derive(Debug)]
pub(super) struct Columns<'a, T, const N: usize> {
    start: *mut T,
    /// From one column to the next.
    stride: usize,
    rows: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<T, const N: usize> Clone for Columns<'_, T, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, const N: usize> Copy for Columns<'_, T, N> {}

impl<'a, T: Copy, const N: usize> Columns<'a, T, N> {
    /// The front of a slice as columns of `length` numbers, or of fewer where it is
    /// too short.
    #[inline(always)]
    pub(super) fn new(slice: &'a mut [T], length: usize) -> Self {
        let length = length.min(slice.len() / N.max(1));
        Self {
            start: slice.as_mut_ptr(),
            stride: length,
            rows: length,
            slice: PhantomData,
        }
    }

    /// The rows from `at` on.
    #[inline(always)]
    pub(super) fn from(self, at: usize) -> Option<Self> {
        let rows = self.rows.checked_sub(at)?;
        Some(Self {
            // SAFETY: `at` rows lie behind the start.
            start: unsafe { self.start.add(at) },
            rows,
            ..self
        })
    }

    /// The rows from `at` on, as many as said: where one number is the length of
    /// several windows, one question is enough for all.
    #[inline(always)]
    pub(super) fn window(self, at: usize, rows: usize) -> Option<Self> {
        if rows > self.rows || at > self.rows - rows {
            return None;
        }
        Some(Self {
            // SAFETY: `at` rows lie behind the start.
            start: unsafe { self.start.add(at) },
            rows,
            ..self
        })
    }

    #[inline(always)]
    fn has<V: Vector<T>>(self, at: usize) -> bool {
        V::LANES <= self.rows && at <= self.rows - V::LANES
    }

    /// The vectors at `at` of the first `M` columns; none where they would cross the
    /// end.
    #[inline(always)]
    pub(super) fn load<V: Vector<T>, const M: usize>(self, at: usize) -> Option<[V; M]> {
        const { assert!(M <= N, "there are not so many columns") };
        if !self.has::<V>(at) {
            return None;
        }
        // SAFETY: in the slice there are `N` columns, `stride` apart, of which each has
        // `rows` numbers from `start` on; by `new`, and kept by `from` and `window`.
        // `has` has seen that `LANES` from `at` on are among them. The slice is borrowed
        // mutably for as long as the views live, which are all in one thread, and no
        // other reference is there now.
        Some(unsafe { read(self.start.add(at), self.stride) })
    }

    /// Writes the vectors at `at` of the first `M` columns; none where they would
    /// cross the end.
    #[inline(always)]
    pub(super) fn store<V: Vector<T>, const M: usize>(
        self,
        at: usize,
        vectors: &[V; M],
    ) -> Option<()> {
        const { assert!(M <= N, "there are not so many columns") };
        if !self.has::<V>(at) {
            return None;
        }
        // SAFETY: as for `load`.
        unsafe { write(vectors, self.start.add(at), self.stride) };
        Some(())
    }
}

/// The vectors at `start`, and so on, `stride` numbers apart.
///
/// # Safety
/// They may be read there.
// A plain loop: iterators are many lines to compile, with each model.
#[inline(always)]
unsafe fn read<T, V: Vector<T>, const M: usize>(start: *const T, stride: usize) -> [V; M] {
    const { assert!(M > 0, "there is a first column") };
    // SAFETY, for all: the caller's.
    let mut vectors = [unsafe { V::read(start) }; M];
    let mut i = 1;
    while i < M {
        vectors[i] = unsafe { V::read(start.add(i * stride)) };
        i += 1;
    }
    vectors
}

/// Writes vectors to `start`, and so on, `stride` numbers apart.
///
/// # Safety
/// They may be written there.
#[inline(always)]
unsafe fn write<T, V: Vector<T>, const M: usize>(vectors: &[V; M], start: *mut T, stride: usize) {
    let mut i = 0;
    while i < M {
        // SAFETY: the caller's.
        unsafe { vectors[i].write(start.add(i * stride)) };
        i += 1;
    }
}

impl<'a, T: Copy, const N: usize> Columns<'a, T, N> {
    /// So many windows of `rows` rows, the first at `at` and the others `apart` from
    /// each other: one question for all of them.
    #[inline(always)]
    pub(super) fn copies(
        self,
        at: usize,
        rows: usize,
        [copies, apart]: [usize; 2],
    ) -> Option<Copies<'a, T, N>> {
        let reach = copies.checked_sub(1)?.checked_mul(apart)?;
        let all = self.window(at, reach.checked_add(rows)?)?;
        Some(Copies {
            first: Self { rows, ..all },
            copies,
            apart,
        })
    }
}

/// Windows of equal length, equally far apart: the copies of links below others.
#[derive(Debug)]
pub(super) struct Copies<'a, T, const N: usize> {
    first: Columns<'a, T, N>,
    copies: usize,
    apart: usize,
}

impl<T, const N: usize> Clone for Copies<'_, T, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, const N: usize> Copy for Copies<'_, T, N> {}

impl<'a, T: Copy, const N: usize> Copies<'a, T, N> {
    /// The vectors at `at` of each window; none where they would cross its end.
    #[inline(always)]
    pub(super) fn at<V: Vector<T>>(self, at: usize) -> Option<AtCopies<'a, T, V, N>> {
        self.first.has::<V>(at).then_some(AtCopies {
            // SAFETY: `at` rows lie behind the start, as `has` has seen.
            start: unsafe { self.first.start.add(at) },
            stride: self.first.stride,
            left: self.copies,
            apart: self.apart,
            slice: PhantomData,
        })
    }
}

/// Vectors at one place of each copy, from the first on.
#[derive(Debug)]
pub(super) struct AtCopies<'a, T, V, const N: usize> {
    /// The next one's.
    start: *mut T,
    stride: usize,
    left: usize,
    apart: usize,
    slice: PhantomData<(&'a mut [T], V)>,
}

impl<T: Copy, V: Vector<T>, const N: usize> AtCopies<'_, T, V, N> {
    /// Where the next one's numbers are.
    #[inline(always)]
    fn next(&mut self) -> Option<*mut T> {
        self.left = self.left.checked_sub(1)?;
        let start = self.start;
        // Behind the last copy there may be nothing to point to.
        self.start = start.wrapping_add(self.apart);
        Some(start)
    }

    /// The next one's first `M` columns.
    #[inline(always)]
    pub(super) fn load<const M: usize>(&mut self) -> Option<[V; M]> {
        const { assert!(M <= N, "there are not so many columns") };
        let start = self.next()?;
        // SAFETY: as for `Columns::load`. `copies` has seen that all windows lie in the
        // columns, `at` that a vector from here on lies in a window.
        Some(unsafe { read(start, self.stride) })
    }

    /// Writes the next one's first `M` columns.
    #[inline(always)]
    pub(super) fn store<const M: usize>(&mut self, vectors: &[V; M]) -> Option<()> {
        const { assert!(M <= N, "there are not so many columns") };
        let start = self.next()?;
        // SAFETY: likewise.
        unsafe { write(vectors, start, self.stride) };
        Some(())
    }
}
