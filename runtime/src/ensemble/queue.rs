//! Handing out items to threads.

use std::sync::atomic::{AtomicUsize, Ordering};

/// The items that no thread has taken yet, and the number of those done.
pub(super) struct Queue<'a> {
    items: usize,
    next: AtomicUsize,
    done: AtomicUsize,
    progress: Option<&'a (dyn Fn(usize) + Sync)>,
}

// The counters carry no data: relaxed order suffices.
impl<'a> Queue<'a> {
    /// A queue of `items` items, none of them taken.
    pub(super) fn new(items: usize, progress: Option<&'a (dyn Fn(usize) + Sync)>) -> Self {
        Self {
            items,
            next: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
            progress,
        }
    }

    /// The index of an item that is this thread's from now on.
    pub(super) fn next(&self) -> Option<usize> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.items).then_some(index)
    }

    /// Counts an item that is done.
    pub(super) fn done(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(progress) = self.progress {
            progress(done);
        }
    }
}
