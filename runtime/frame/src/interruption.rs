//! Requests to terminate that the program handles itself.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// State of a request to terminate that the program handles itself.
#[derive(Debug, Default)]
pub(super) struct Interruption {
    taken: AtomicBool,
    signal: AtomicI32,
}

// These share no other data between threads: relaxed order suffices.
impl Interruption {
    /// From now on, lets the program handle the first request itself, unless one has already
    /// arrived.
    pub(super) fn take(&self) {
        if self.signal().is_none() {
            self.taken.store(true, Ordering::Relaxed);
        }
    }

    /// Returns the number of the signal, if one has arrived and the program handles it.
    pub(super) fn signal(&self) -> Option<i32> {
        Some(self.signal.load(Ordering::Relaxed)).filter(|signal| *signal != 0)
    }

    /// Leaves a signal to the program. Returns false if the program does not handle it.
    #[cfg(unix)]
    pub(super) fn leave(&self, signal: i32) -> bool {
        let taken = self.taken.swap(false, Ordering::Relaxed);
        if taken {
            self.signal.store(signal, Ordering::Relaxed);
        }
        taken
    }
}
