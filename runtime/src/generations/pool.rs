//! Room for evaluations, allocated once.

use alloc::vec::Vec;

/// Buffers that evaluations borrow. There are as many as there were evaluations
/// at one time: a model that one thread uses holds one.
///
/// Without the feature `std`, which has the lock, every evaluation allocates.
#[derive(Debug)]
pub(super) struct Pool<T> {
    #[cfg(feature = "std")]
    spare: std::sync::Mutex<Vec<Vec<T>>>,
    #[cfg(not(feature = "std"))]
    spare: core::marker::PhantomData<T>,
}

impl<T> Pool<T> {
    pub(super) fn new() -> Self {
        Self {
            #[cfg(feature = "std")]
            spare: std::sync::Mutex::new(Vec::new()),
            #[cfg(not(feature = "std"))]
            spare: core::marker::PhantomData,
        }
    }
}

impl<T: Copy> Pool<T> {
    /// Lends a buffer of at least `length` numbers to `work`. What they are is
    /// left open.
    pub(super) fn lend<R>(&self, length: usize, zero: T, work: impl FnOnce(&mut [T]) -> R) -> R {
        #[cfg(feature = "std")]
        let mut buffer = {
            // A thread that panicked left no buffer half written: it kept it.
            let mut spare = self
                .spare
                .lock()
                .unwrap_or_else(|poisoned| poisoned.into_inner());
            spare.pop().unwrap_or_default()
        };
        #[cfg(not(feature = "std"))]
        let mut buffer = Vec::new();
        if buffer.len() < length {
            buffer.resize(length, zero);
        }
        let result = work(&mut buffer);
        #[cfg(feature = "std")]
        self.spare
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner())
            .push(buffer);
        result
    }
}
