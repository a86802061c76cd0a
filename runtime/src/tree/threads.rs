//! Jobs on threads.

/// Returns the default number of threads for a tree of `links` links.
pub(super) fn default(links: usize) -> usize {
    #[cfg(feature = "std")]
    if links >= super::THREADED {
        return std::thread::available_parallelism().map_or(1, core::num::NonZeroUsize::get);
    }
    let _ = links;
    1
}

/// Runs `work` on all `jobs` in parallel, each on a separate thread; the first one runs on this
/// thread. Without the feature `std`, they run one after the other.
pub(super) fn all<J: Send>(jobs: impl Iterator<Item = J>, work: impl Fn(J) + Sync) {
    let mut jobs = jobs.peekable();
    let Some(first) = jobs.next() else {
        return;
    };
    if jobs.peek().is_none() {
        work(first);
        return;
    }
    #[cfg(feature = "std")]
    std::thread::scope(|scope| {
        let work = &work;
        for job in jobs {
            scope.spawn(move || work(job));
        }
        work(first);
    });
    #[cfg(not(feature = "std"))]
    {
        work(first);
        jobs.for_each(work);
    }
}
