//! A slice that several threads write to, each to elements of its own.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::vector::Vector;

/// A mutable slice whose elements are written from several places.
#[derive(Debug)]
pub(super) struct Shared<'a, T> {
    start: *mut T,
    length: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<T> Clone for Shared<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Shared<'_, T> {}

// SAFETY: it gives nothing but `write`, whose callers see to it that no element
// is written from two threads.
unsafe impl<T: Send> Send for Shared<'_, T> {}

impl<'a, T: Copy> Shared<'a, T> {
    pub(super) fn new(slice: &'a mut [T]) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            length: slice.len(),
            slice: PhantomData,
        }
    }

    /// Writes the first `count` numbers of a vector from `slice[at]` on, as
    /// [`write`](Self::write).
    #[inline(always)]
    pub(super) fn store<V: Vector<T>>(&mut self, at: usize, vector: V, count: usize) {
        let length = count.min(V::LANES);
        if at <= self.length && length <= self.length - at {
            // SAFETY: as for `write`.
            let place = unsafe { core::slice::from_raw_parts_mut(self.start.add(at), length) };
            vector.store(place, 0);
        }
    }

    /// Writes `values` from `slice[at]` on; nothing where they do not fit. Of two
    /// threads that write at one time, each must write elsewhere: the parts of a
    /// tree have no link in common.
    #[inline(always)]
    pub(super) fn write(&mut self, at: usize, values: &[T]) {
        if at <= self.length && values.len() <= self.length - at {
            // SAFETY: the elements lie in the slice, which is borrowed mutably for
            // as long as this lives; `values` is another one. No other thread
            // writes there, and none reads before all are done.
            unsafe {
                core::ptr::copy_nonoverlapping(values.as_ptr(), self.start.add(at), values.len());
            }
        }
    }
}
