//! A slice that several threads write to, each to elements of its own.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::output::Output;
use super::prefetch::prefetch;
use crate::scalar::Scalar;
use crate::simd::Simd;

/// A mutable slice whose elements are written from several places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared<'a, T> {
    start: *mut T,
    length: usize,
    slice: PhantomData<&'a mut [T]>,
}

// SAFETY: its functions' callers see to it that no element is written from one thread
// while another one writes or reads it.
unsafe impl<T: Send> Send for Shared<'_, T> {}

impl<'a, T: Copy> Shared<'a, T> {
    pub(super) fn new(slice: &'a mut [T]) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            length: slice.len(),
            slice: PhantomData,
        }
    }

    /// The numbers from `at` on.
    #[inline(always)]
    pub(super) fn from(self, at: usize) -> Option<Self> {
        let length = self.length.checked_sub(at)?;
        Some(Self {
            start: self.start.wrapping_add(at),
            length,
            ..self
        })
    }

    /// `length` numbers from `at` on.
    pub(super) fn window(self, at: usize, length: usize) -> Option<Self> {
        let rest = self.from(at)?;
        (length <= rest.length).then_some(Self { length, ..rest })
    }

    /// Asks the memory for the line of a number that will be written soon.
    #[inline(always)]
    pub(super) fn prefetch(self, at: usize) {
        prefetch(self.start.wrapping_add(at));
    }

    /// Writes numbers from `at` on; none where they do not fit. Of two threads that
    /// write at one time, each must write elsewhere: the blocks of a tree have no link
    /// in common.
    pub(super) fn write(self, at: usize, numbers: &[T]) {
        if at <= self.length && numbers.len() <= self.length - at {
            // SAFETY: the elements lie in the slice, which is borrowed mutably for as
            // long as this lives. No other thread writes there, and none reads before
            // all are done.
            let places =
                unsafe { core::slice::from_raw_parts_mut(self.start.add(at), numbers.len()) };
            places.copy_from_slice(numbers);
        }
    }

    /// Reads numbers from `at` on into `places`; none where there are not so many.
    /// The numbers are the reader's own, or nobody writes at that time.
    pub(super) fn read(self, at: usize, places: &mut [T]) {
        if at <= self.length && places.len() <= self.length - at {
            // SAFETY: the elements lie in the slice, and no other thread writes them
            // now.
            let numbers = unsafe { core::slice::from_raw_parts(self.start.add(at), places.len()) };
            places.copy_from_slice(numbers);
        }
    }
}

impl<T: Scalar> Output<T> for Shared<'_, T> {
    #[inline(always)]
    unsafe fn write<V: Simd<T>>(&mut self, at: usize, alpha: V, count: usize) {
        let place = self.start.wrapping_add(at);
        // SAFETY: the caller's: this is as long as the strips of the block reach.
        unsafe {
            match count < V::LANES {
                true => alpha.write_some(place, count),
                false => alpha.write(place),
            }
        }
    }
}
