//! Columns of numbers, equally long, that are read and written at one place.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::equations::Row;
use crate::simd::Simd;

/// Numbers of a slice as `N` columns, or some rows of these.
///
/// As slices of their own, each column would ask whether a place lies in it, every
/// time: many questions with one respond, and more instructions than the mechanics.
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
        V::LANES <= self.rows && at <= self.rows - V::LANES
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
        // `rows` numbers from `start` on; by `new`, and kept by `window`. `has` has
        // seen that `LANES` from `at` on are among them. The slice is borrowed mutably
        // for as long as the views live, which are all in one thread, and no other
        // reference is there now.
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
pub(super) unsafe fn read<T, V: Simd<T>, A: Row<V>>(start: *const T, stride: usize) -> A {
    let mut vectors = A::filled(V::from_f64(0.0));
    let mut i = 0;
    while i < A::LENGTH {
        // SAFETY: the caller's.
        vectors.as_mut()[i] = unsafe { V::read(start.add(i * stride)) };
        i += 1;
    }
    vectors
}

/// Writes vectors to `start`, and so on, `stride` numbers apart.
///
/// # Safety
/// They may be written there.
#[inline(always)]
pub(super) unsafe fn write<T, V: Simd<T>, A: Row<V>>(vectors: &A, start: *mut T, stride: usize) {
    let mut i = 0;
    while i < A::LENGTH {
        // SAFETY: the caller's.
        unsafe { vectors.as_ref()[i].write(start.add(i * stride)) };
        i += 1;
    }
}
