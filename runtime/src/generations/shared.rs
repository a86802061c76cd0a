//! A slice that several threads write to, each to elements of its own.

#![allow(unsafe_code)]

use core::marker::PhantomData;

use super::prefetch::prefetch;
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
            // SAFETY: `at` elements lie behind the start.
            start: unsafe { self.start.add(at) },
            length,
            ..self
        })
    }

    /// Asks the memory for the line of a number that will be written soon.
    #[inline(always)]
    pub(super) fn prefetch(self, at: usize) {
        prefetch(self.start.wrapping_add(at));
    }

    /// Writes the first `count` numbers of a vector from `at` on, all where there
    /// are not so many; none where they do not fit. Of two threads that write at one
    /// time, each must write elsewhere: the parts of a tree have no link in common.
    #[inline(always)]
    pub(super) fn store<V: Vector<T>>(self, at: usize, vector: V, count: usize) {
        // SAFETY, for both: the elements lie in the slice, which is borrowed mutably
        // for as long as this lives. No other thread writes there, and none reads
        // before all are done.
        if count >= V::LANES {
            if V::LANES <= self.length && at <= self.length - V::LANES {
                unsafe { vector.write(self.start.add(at)) };
            }
        } else if at <= self.length && count <= self.length - at {
            let places = unsafe { core::slice::from_raw_parts_mut(self.start.add(at), count) };
            vector.store(places, 0);
        }
    }

    /// Writes numbers from `at` on; none where they do not fit. As for
    /// [`store`](Self::store).
    pub(super) fn write(self, at: usize, numbers: &[T]) {
        if at <= self.length && numbers.len() <= self.length - at {
            // SAFETY: as for `store`.
            let places =
                unsafe { core::slice::from_raw_parts_mut(self.start.add(at), numbers.len()) };
            places.copy_from_slice(numbers);
        }
    }

    /// Reads numbers from `at` on into `places`; none where there are not so many.
    /// They are the reader's own, or nobody writes at that time.
    pub(super) fn read(self, at: usize, places: &mut [T]) {
        if at <= self.length && places.len() <= self.length - at {
            // SAFETY: the elements lie in the slice, and no other thread writes them
            // now.
            let numbers = unsafe { core::slice::from_raw_parts(self.start.add(at), places.len()) };
            places.copy_from_slice(numbers);
        }
    }

    /// `count` numbers from `at` on, and as many of each other copy, so far apart.
    #[inline(always)]
    pub(super) fn copies(
        self,
        at: usize,
        count: usize,
        [copies, apart]: [usize; 2],
    ) -> Option<Copies<'a, T>> {
        let reach = copies.checked_sub(1)?.checked_mul(apart)?;
        let rest = self.from(at)?;
        (reach.checked_add(count)? <= rest.length).then_some(Copies {
            first: Self {
                length: count,
                ..rest
            },
            copies,
            apart,
        })
    }
}

/// Runs of equal length, equally far apart.
#[derive(Debug)]
pub(super) struct Copies<'a, T> {
    first: Shared<'a, T>,
    copies: usize,
    apart: usize,
}

impl<T> Clone for Copies<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Copies<'_, T> {}

impl<'a, T: Copy> Copies<'a, T> {
    /// Places for vectors at `at` in each run.
    #[inline(always)]
    pub(super) fn at(self, at: usize) -> AtCopies<'a, T> {
        AtCopies { runs: self, at }
    }
}

/// Places for vectors in runs, from the first on.
#[derive(Debug)]
pub(super) struct AtCopies<'a, T> {
    runs: Copies<'a, T>,
    at: usize,
}

impl<T: Copy> AtCopies<'_, T> {
    /// Writes to the next run, as [`Shared::store`] does with its length.
    #[inline(always)]
    pub(super) fn store<V: Vector<T>>(&mut self, vector: V) -> Option<()> {
        let runs = &mut self.runs;
        runs.copies = runs.copies.checked_sub(1)?;
        runs.first.store(self.at, vector, runs.first.length);
        // Behind the last run, where this may point to nothing, there is no store.
        runs.first.start = runs.first.start.wrapping_add(runs.apart);
        Some(())
    }
}
