//! Views of a slice as columns of equal length, read and written at one index.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::equations::Row;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// View of a slice as a table with `N` columns, or of some rows of such a table. [`Rows`] can be
/// viewed as columns too.
///
/// If each column were a separate slice, every access would check the index once per column, which
/// costs more instructions than the mechanics itself. Copies of a view refer to the same numbers,
/// as copies of a slice of cells do.
#[derive(Clone, Copy, Debug)]
pub(super) struct Columns<'a, T, const N: usize> {
    start: *mut T,
    /// Distance, in numbers, from one column to the next, and from one row to the next.
    stride: usize,
    row: usize,
    rows: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<'a, T: Copy, const N: usize> Columns<'a, T, N> {
    /// Creates a view of the front of a slice as columns of `length` numbers, or of fewer if the
    /// slice is too short.
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

    /// Returns a view of the `rows` rows from index `at` on. If several windows have the same
    /// length, the compiler needs only one bounds check.
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

    /// Returns a pointer to the start of the first column.
    pub(super) fn start(self) -> *mut T {
        self.start
    }

    /// Returns the distance, in numbers, from one column to the next.
    pub(super) fn stride(self) -> usize {
        self.stride
    }

    #[inline(always)]
    fn has<V: Simd<T>>(self, at: usize) -> bool {
        // In views of rows, the numbers of several links are not contiguous.
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

    /// Reads one vector from each column at row `at`; `None` if the vectors would cross the end.
    #[inline(always)]
    pub(super) fn load<V: Simd<T>>(self, at: usize) -> Option<[V; N]> {
        if !self.has::<V>(at) {
            return None;
        }
        // SAFETY: as in `store`; the values are copied at once.
        Some(unsafe { self.cells().read(at) })
    }

    /// Writes one vector to each of the first `M` columns at row `at`. Returns `None` if the
    /// vectors would cross the end.
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
        // SAFETY: the slice holds `N` columns, `stride` apart, each with `rows` numbers from
        // `start` on, `row` apart. `new` and `Rows::columns` establish this, and `window` keeps it.
        // `has` has checked that `LANES` numbers from `at` on are among them. The slice is mutably
        // borrowed while the views live, all views are in one thread, and no other reference exists
        // now.
        unsafe { self.cells().write(at, vectors) };
        Some(())
    }
}

/// View of a slice as rows of equal width, one after the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows<'a, T> {
    start: *mut T,
    width: usize,
    rows: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<'a, T> Rows<'a, T> {
    /// Creates a view of the front of a slice as rows of `width` numbers.
    #[inline(always)]
    pub(super) fn new(slice: &'a mut [T], width: usize) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            width,
            rows: slice.len() / width.max(1),
            slice: PhantomData,
        }
    }

    /// Returns a view of `N` columns, from column `first` on; `None` if a row has fewer columns.
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

/// Memory layout of the numbers of links: number `i` of link `at` has the offset `at · row + i ·
/// stride`. If numbers are stored in columns, the links are contiguous; if in rows, the numbers of
/// one link are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells<T> {
    start: *mut T,
    row: usize,
    stride: usize,
}

impl<T: Copy> Cells<T> {
    /// Returns the layout for columns whose starts are `stride` numbers apart.
    #[inline(always)]
    pub(super) fn columns(start: *mut T, stride: usize) -> Self {
        Self {
            start,
            row: 1,
            stride,
        }
    }

    /// Returns the layout for rows of `row` numbers.
    #[inline(always)]
    pub(super) fn rows(start: *mut T, row: usize) -> Self {
        Self {
            start,
            row,
            stride: 1,
        }
    }

    /// Returns the layout that starts with link `at`.
    #[inline(always)]
    pub(super) fn from(self, at: usize) -> Self {
        Self {
            start: self.start.wrapping_add(at * self.row),
            ..self
        }
    }

    /// Returns the address of number `i` of link `at`.
    #[inline(always)]
    pub(super) fn place(self, at: usize, i: usize) -> *mut T {
        self.start.wrapping_add(at * self.row + i * self.stride)
    }

    /// Reads the numbers of link `at`; if `V` has several lanes, of the links from `at` on, one in
    /// each lane.
    ///
    /// # Safety
    /// The numbers must be valid for reads.
    // A plain loop: iterators take long to compile, with each model.
    #[inline(always)]
    pub(super) unsafe fn read<V: Simd<T>, A: Row<V>>(self, at: usize) -> A {
        let start = self.from(at).start;
        let mut vectors = A::filled(V::from_f64(0.0));
        let mut i = 0;
        while i < A::LENGTH {
            // SAFETY: the caller guarantees valid reads.
            vectors.as_mut()[i] = unsafe { V::read(start.add(i * self.stride)) };
            i += 1;
        }
        vectors
    }

    /// Writes the numbers of link `at`; if `V` has several lanes, of the links from `at` on, one in
    /// each lane.
    ///
    /// # Safety
    /// The numbers must be valid for writes.
    #[inline(always)]
    pub(super) unsafe fn write<V: Simd<T>, A: Row<V>>(self, at: usize, vectors: &A) {
        let start = self.from(at).start;
        let mut i = 0;
        while i < A::LENGTH {
            // SAFETY: the caller guarantees valid writes.
            unsafe { vectors.as_ref()[i].write(start.add(i * self.stride)) };
            i += 1;
        }
    }
}

/// Reads the vector that starts at index `place`; NaN if there are too few numbers.
#[inline(always)]
pub(super) fn load<T: Scalar, V: Simd<T>>(numbers: &[T], place: usize) -> V {
    match V::load(numbers.get(place..).unwrap_or_default()) {
        Some(row) => row,
        None => V::from_f64(f64::NAN),
    }
}

/// Reads the vector that starts at index `place`; missing numbers are zero.
#[inline(always)]
pub(super) fn load_front<T: Scalar, V: Simd<T>>(numbers: &[T], place: usize) -> V {
    V::load_front(numbers.get(place..).unwrap_or_default())
}
