//! Room for evaluations, allocated once.

use alloc::vec::Vec;

/// Buffers that evaluations borrow. There are as many as there were evaluations
/// at one time: a model that one thread uses holds one.
///
/// Without the feature `std`, which has the locks, every evaluation allocates.
#[derive(Debug)]
pub(super) struct Pool<T> {
    /// Whoever comes first.
    #[cfg(feature = "std")]
    first: std::sync::Mutex<Vec<T>>,
    /// For evaluations that find it lent.
    #[cfg(feature = "std")]
    others: std::sync::Mutex<Vec<Vec<T>>>,
    #[cfg(not(feature = "std"))]
    none: core::marker::PhantomData<T>,
}

impl<T> Pool<T> {
    pub(super) fn new() -> Self {
        Self {
            #[cfg(feature = "std")]
            first: std::sync::Mutex::new(Vec::new()),
            #[cfg(feature = "std")]
            others: std::sync::Mutex::new(Vec::new()),
            #[cfg(not(feature = "std"))]
            none: core::marker::PhantomData,
        }
    }
}

fn grown<T: Copy>(buffer: &mut Vec<T>, length: usize, zero: T) -> &mut [T] {
    if buffer.len() < length {
        buffer.resize(length, zero);
    }
    buffer
}

impl<T: Copy> Pool<T> {
    /// Lends a buffer of at least `length` numbers to `work`. What they are is
    /// left open, so that it does not matter if an earlier borrower panicked.
    #[cfg(feature = "std")]
    #[inline]
    pub(super) fn lend<R>(&self, length: usize, zero: T, work: impl FnOnce(&mut [T]) -> R) -> R {
        use std::sync::{PoisonError, TryLockError};
        match self.first.try_lock() {
            Ok(mut buffer) => return work(grown(&mut buffer, length, zero)),
            Err(TryLockError::Poisoned(poisoned)) => {
                return work(grown(&mut poisoned.into_inner(), length, zero));
            }
            Err(TryLockError::WouldBlock) => {}
        }
        let others = || self.others.lock().unwrap_or_else(PoisonError::into_inner);
        let mut buffer = others().pop().unwrap_or_default();
        let result = work(grown(&mut buffer, length, zero));
        others().push(buffer);
        result
    }

    /// A buffer of at least `length` numbers, to be given back: for work that must
    /// be compiled where it is asked for.
    #[cfg(feature = "std")]
    pub(super) fn take(&self, length: usize, zero: T) -> Vec<T> {
        use std::sync::PoisonError;
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        let mut buffer = others.pop().unwrap_or_default();
        drop(others);
        grown(&mut buffer, length, zero);
        buffer
    }

    /// Keeps a buffer for the next evaluation.
    #[cfg(feature = "std")]
    pub(super) fn give_back(&self, buffer: Vec<T>) {
        use std::sync::PoisonError;
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        others.push(buffer);
    }

    /// A buffer, allocated for this once.
    #[cfg(not(feature = "std"))]
    pub(super) fn take(&self, length: usize, zero: T) -> Vec<T> {
        let mut buffer = Vec::new();
        grown(&mut buffer, length, zero);
        buffer
    }

    #[cfg(not(feature = "std"))]
    pub(super) fn give_back(&self, _buffer: Vec<T>) {}

    /// The same, allocated for this once.
    #[cfg(not(feature = "std"))]
    pub(super) fn lend<R>(&self, length: usize, zero: T, work: impl FnOnce(&mut [T]) -> R) -> R {
        work(grown(&mut Vec::new(), length, zero))
    }
}
