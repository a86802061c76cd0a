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
        let rest = self.from(at)?;
        (rows <= rest.rows).then_some(Self { rows, ..rest })
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
        let mut vectors = [V::from_f64(0.0); M];
        let mut i = 0;
        while i < M {
            // SAFETY: in the slice there are `N` columns, `stride` apart, of which
            // each has `rows` numbers from `start` on; by `new`, and kept by `from`
            // and `window`. `has` has seen that `LANES` from `at` on are among them.
            // The slice is borrowed mutably for as long as the views live, which are
            // all in one thread, and no other reference is there now.
            vectors[i] = unsafe { V::read(self.start.add(i * self.stride + at)) };
            i += 1;
        }
        Some(vectors)
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
        let mut i = 0;
        while i < M {
            // SAFETY: as for `load`.
            unsafe { vectors[i].write(self.start.add(i * self.stride + at)) };
            i += 1;
        }
        Some(())
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
        self.window(at, reach.checked_add(rows)?)?;
        Some(Copies {
            first: self.window(at, rows)?,
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
        let mut vectors = [V::from_f64(0.0); M];
        let mut i = 0;
        while i < M {
            // SAFETY: as for `Columns::load`. `copies` has seen that all windows lie in
            // the columns, `at` that a vector from here on lies in a window.
            vectors[i] = unsafe { V::read(start.add(i * self.stride)) };
            i += 1;
        }
        Some(vectors)
    }

    /// Writes the next one's first `M` columns.
    #[inline(always)]
    pub(super) fn store<const M: usize>(&mut self, vectors: &[V; M]) -> Option<()> {
        const { assert!(M <= N, "there are not so many columns") };
        let start = self.next()?;
        let mut i = 0;
        while i < M {
            // SAFETY: likewise.
            unsafe { vectors[i].write(start.add(i * self.stride)) };
            i += 1;
        }
        Some(())
    }
}
