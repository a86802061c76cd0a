//! A request to end that a program takes itself.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// A request to end that a program takes itself.
#[derive(Debug, Default)]
pub(super) struct Interruption {
    taken: AtomicBool,
    signal: AtomicI32,
}

// Nothing else is told between threads by these: relaxed order suffices.
impl Interruption {
    /// From now on the program takes the first request itself, unless it has come.
    pub(super) fn take(&self) {
        if self.signal().is_none() {
            self.taken.store(true, Ordering::Relaxed);
        }
    }

    /// Number of the signal that came, if one did and the program takes it.
    pub(super) fn signal(&self) -> Option<i32> {
        Some(self.signal.load(Ordering::Relaxed)).filter(|signal| *signal != 0)
    }

    /// Leaves a signal to the program; false where it does not take it.
    #[cfg(unix)]
    pub(super) fn leave(&self, signal: i32) -> bool {
        let taken = self.taken.swap(false, Ordering::Relaxed);
        if taken {
            self.signal.store(signal, Ordering::Relaxed);
        }
        taken
    }
}
