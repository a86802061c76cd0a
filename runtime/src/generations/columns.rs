//! Columns of numbers, equally long, that are read and written at one place.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::vector::Vector;

/// The front of a slice as `N` columns of equal length.
///
/// As slices of their own, each would ask whether a place lies in it, every time:
/// many questions with one answer, and more instructions than the mechanics.
#[derive(Debug)]
pub(super) struct Columns<'a, T, const N: usize> {
    start: *mut T,
    length: usize,
    slice: PhantomData<&'a mut [T]>,
}

/// A vector's place in columns.
#[derive(Debug)]
pub(super) struct Row<'a, T, V, const N: usize> {
    columns: &'a Columns<'a, T, N>,
    at: usize,
    vector: PhantomData<V>,
}

/// One to be written.
#[derive(Debug)]
pub(super) struct RowMut<'a, 'b, T, V, const N: usize> {
    columns: &'a mut Columns<'b, T, N>,
    at: usize,
    vector: PhantomData<V>,
}

impl<'a, T: Copy, const N: usize> Columns<'a, T, N> {
    /// Columns of `length` numbers; empty ones where the slice is too short.
    #[inline(always)]
    pub(super) fn new(slice: &'a mut [T], length: usize) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            length: length.min(slice.len() / N.max(1)),
            slice: PhantomData,
        }
    }

    #[inline(always)]
    fn has(&self, at: usize, lanes: usize) -> bool {
        lanes <= self.length && at <= self.length - lanes
    }

    /// The row of vectors that starts at `at`; none that crosses the end.
    #[inline(always)]
    pub(super) fn row<V: Vector<T>>(&self, at: usize) -> Option<Row<'_, T, V, N>> {
        self.has(at, V::LANES).then_some(Row {
            columns: self,
            at,
            vector: PhantomData,
        })
    }

    /// The same, to be written.
    #[inline(always)]
    pub(super) fn row_mut<V: Vector<T>>(&mut self, at: usize) -> Option<RowMut<'_, 'a, T, V, N>> {
        self.has(at, V::LANES).then_some(RowMut {
            columns: self,
            at,
            vector: PhantomData,
        })
    }
}

impl<T: Copy, V: Vector<T>, const N: usize> Row<'_, T, V, N> {
    /// The first `M` of its vectors.
    #[inline(always)]
    pub(super) fn load<const M: usize>(&self) -> [V; M] {
        const { assert!(M <= N, "there are not so many columns") };
        let mut vectors = [V::from_f64(0.0); M];
        for i in 0..M {
            // SAFETY: there are `N` columns of `length` numbers in the slice, by
            // `Columns::new`, and `row` has seen that `LANES` from `at` on lie in
            // each. The slice is borrowed for as long as the columns live. Nothing
            // writes to it meanwhile: that takes `&mut Columns`.
            vectors[i] = unsafe {
                let start = self.columns.start.add(i * self.columns.length + self.at);
                V::read(start)
            };
        }
        vectors
    }
}

impl<T: Copy, V: Vector<T>, const N: usize> RowMut<'_, '_, T, V, N> {
    /// Writes to the first `M` columns.
    #[inline(always)]
    pub(super) fn store<const M: usize>(&mut self, vectors: [V; M]) {
        const { assert!(M <= N, "there are not so many columns") };
        for i in 0..M {
            // SAFETY: as for `Row::load`, and the columns are borrowed mutably.
            unsafe {
                let start = self.columns.start.add(i * self.columns.length + self.at);
                vectors[i].write(start);
            }
        }
    }
}
