//! Distribution of items to threads.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Items that no thread has taken yet, and a count of finished items.
pub(super) struct Queue<'a> {
    items: usize,
    next: AtomicUsize,
    done: AtomicUsize,
    progress: Option<&'a (dyn Fn(usize) + Sync)>,
}

// The counters carry no other data, so relaxed ordering suffices.
impl<'a> Queue<'a> {
    /// Creates a queue of `items` items, none of them taken.
    pub(super) fn new(items: usize, progress: Option<&'a (dyn Fn(usize) + Sync)>) -> Self {
        Self {
            items,
            next: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
            progress,
        }
    }

    /// Takes the next item for this thread; returns its index, or `None` if there are no more.
    pub(super) fn next(&self) -> Option<usize> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.items).then_some(index)
    }

    /// Counts a finished item.
    pub(super) fn done(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(progress) = self.progress {
            progress(done);
        }
    }
}
