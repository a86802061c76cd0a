//! A slice to which several threads write, each thread to different elements.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::output::Output;
use super::prefetch::prefetch;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// View of a mutable slice; copies of the view can be used to write to the same slice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared<'a, T> {
    start: *mut T,
    length: usize,
    slice: PhantomData<&'a mut [T]>,
}

// SAFETY: the callers of its functions ensure that no element is written by one thread while
// another one writes or reads it.
unsafe impl<T: Send> Send for Shared<'_, T> {}

impl<'a, T: Copy> Shared<'a, T> {
    pub(super) fn new(slice: &'a mut [T]) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            length: slice.len(),
            slice: PhantomData,
        }
    }

    /// Returns the part of the slice from index `at` on; `None` if `at` is past the end.
    #[inline(always)]
    pub(super) fn from(self, at: usize) -> Option<Self> {
        let length = self.length.checked_sub(at)?;
        Some(Self {
            start: self.start.wrapping_add(at),
            length,
            ..self
        })
    }

    /// Returns the `length` numbers from index `at` on; `None` if there are fewer.
    pub(super) fn window(self, at: usize, length: usize) -> Option<Self> {
        let rest = self.from(at)?;
        (length <= rest.length).then_some(Self { length, ..rest })
    }

    /// Prefetches the cache line of a number that will be written soon.
    #[inline(always)]
    pub(super) fn prefetch(self, at: usize) {
        prefetch(self.start.wrapping_add(at));
    }

    /// Writes numbers from index `at` on; writes nothing if they do not fit. Two threads that write
    /// at the same time must write to different elements, which holds because the blocks of a tree
    /// have no link in common.
    pub(super) fn write(self, at: usize, numbers: &[T]) {
        if at <= self.length && numbers.len() <= self.length - at {
            // SAFETY: the elements lie in the slice, which is mutably borrowed while this view
            // lives. No other thread writes to them, and none reads them before all have finished.
            let places =
                unsafe { core::slice::from_raw_parts_mut(self.start.add(at), numbers.len()) };
            places.copy_from_slice(numbers);
        }
    }

    /// Reads numbers from index `at` on into `places`; reads nothing if there are too few. No other
    /// thread may write these numbers at the same time.
    pub(super) fn read(self, at: usize, places: &mut [T]) {
        if at <= self.length && places.len() <= self.length - at {
            // SAFETY: the elements lie in the slice, and no other thread writes them now.
            let numbers = unsafe { core::slice::from_raw_parts(self.start.add(at), places.len()) };
            places.copy_from_slice(numbers);
        }
    }
}

impl<T: Scalar> Output<T> for Shared<'_, T> {
    #[inline(always)]
    unsafe fn write<V: Simd<T>>(&mut self, at: usize, alpha: V, count: usize) {
        let place = self.start.wrapping_add(at);
        // SAFETY: the caller guarantees that the slice reaches as far as the strips of the block.
        unsafe {
            match count < V::LANES {
                true => alpha.write_some(place, count),
                false => alpha.write(place),
            }
        }
    }
}
