//! Computations that can be ended from outside, in the middle of their steps.
//!
//! Methods, ensembles and searches [`look`] between two steps whether their computation is to
//! go on. Where it is not, it ends by unwinding, and [`interruptible`] catches that: functions
//! in between need not know of it.

#[cfg(feature = "std")]
pub use self::watched::{Interrupted, interruptible};
#[cfg(feature = "std")]
pub(crate) use self::watched::{SharedWatcher, Watcher};

/// Ends the computation if it is [`interruptible`] and was interrupted; of use in loops that
/// run for long. Costs some nanoseconds, where nothing can be interrupted one.
#[inline]
pub fn look() {
    #[cfg(feature = "std")]
    watched::look();
}

#[cfg(feature = "std")]
mod watched {
    use std::boxed::Box;
    use std::cell::RefCell;
    use std::fmt;
    use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::{Duration, Instant};

    /// Time between two questions.
    const PAUSE: Duration = Duration::from_millis(20);

    /// A computation was interrupted; nothing is left of it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Interrupted;

    impl fmt::Display for Interrupted {
        fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("the computation was interrupted")
        }
    }

    impl std::error::Error for Interrupted {}

    /// One computation, as each of its threads sees it.
    #[derive(Clone)]
    pub(crate) struct Watcher {
        is_over: Arc<AtomicBool>,
        /// Who is asked, and when the next time; by the thread that began alone.
        question: Option<(Arc<dyn Fn() -> bool>, Instant)>,
    }

    thread_local! {
        static OWN: RefCell<Option<Watcher>> = const { RefCell::new(None) };
    }

    /// Puts the watcher before back in its place.
    struct Before(Option<Watcher>);

    impl Drop for Before {
        fn drop(&mut self) {
            let before = self.0.take();
            OWN.with(|own| own.replace(before));
        }
    }

    impl Watcher {
        fn watch<R>(self, work: impl FnOnce() -> R) -> R {
            let _before = Before(OWN.with(|own| own.replace(Some(self))));
            work()
        }

        /// The watcher of this thread's computation as its other threads have it; none where
        /// it cannot be interrupted.
        pub(crate) fn of_others() -> Option<SharedWatcher> {
            OWN.with(|own| {
                let is_over = own.borrow().as_ref()?.is_over.clone();
                Some(SharedWatcher(is_over))
            })
        }
    }

    /// What other threads look at.
    #[derive(Clone)]
    pub(crate) struct SharedWatcher(Arc<AtomicBool>);

    impl SharedWatcher {
        /// Does work that belongs to the computation.
        pub(crate) fn watch<R>(self, work: impl FnOnce() -> R) -> R {
            let watcher = Watcher {
                is_over: self.0,
                question: None,
            };
            watcher.watch(work)
        }
    }

    #[inline]
    pub(super) fn look() {
        let question = OWN.with(|own| {
            let mut own = own.borrow_mut();
            let watcher = own.as_mut()?;
            if watcher.is_over.load(Ordering::Relaxed) {
                return Some((watcher.is_over.clone(), None));
            }
            let (ask, next) = watcher.question.as_mut()?;
            let now = Instant::now();
            if now < *next {
                return None;
            }
            *next = now + PAUSE;
            Some((watcher.is_over.clone(), Some(ask.clone())))
        });
        // Whoever is asked may begin a computation of its own on this thread.
        if let Some((is_over, ask)) = question {
            answer(&is_over, ask);
        }
    }

    #[cold]
    fn answer(is_over: &AtomicBool, ask: Option<Arc<dyn Fn() -> bool>>) {
        if ask.is_none_or(|ask| ask()) {
            is_over.store(true, Ordering::Relaxed);
            // No panic: nothing is written to the standard error.
            resume_unwind(Box::new(Interrupted));
        }
    }

    /// Does work that ends early where `is_unwanted` returns true. This thread asks it some fifty
    /// times a second, where it [`look`](super::look)s; threads of an
    /// [`Ensemble`](crate::ensemble::Ensemble) end with it.
    ///
    /// The work ends by unwinding: in programs that abort where others unwind it would end them.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::interruption::{Interrupted, interruptible};
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::system::OdeFn;
    /// use std::ops::ControlFlow;
    /// use std::time::{Duration, Instant};
    ///
    /// let oscillator = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
    ///     rates.copy_from_slice(&[y[1], -y[0]]);
    /// });
    /// let start = State::at_rest(0.0, &[1.0]);
    /// // An hour of it.
    /// let method = Rk4::new(1e-6);
    /// let motion = || {
    ///     method.run(&oscillator, &start, 1e5)
    /// };
    /// let begin = Instant::now();
    /// let is_late = move || begin.elapsed() > Duration::from_millis(100);
    /// assert_eq!(interruptible(is_late, motion), Err(Interrupted));
    /// ```
    pub fn interruptible<R>(
        is_unwanted: impl Fn() -> bool + 'static,
        work: impl FnOnce() -> R,
    ) -> Result<R, Interrupted> {
        let is_over = Arc::new(AtomicBool::new(false));
        let watcher = Watcher {
            is_over: is_over.clone(),
            question: Some((Arc::new(is_unwanted), Instant::now() + PAUSE)),
        };
        // What the work has changed is dropped with it or belongs to the caller, who is told.
        let outcome = catch_unwind(AssertUnwindSafe(|| watcher.watch(work)));
        outcome.map_err(|cause| match cause.downcast::<Interrupted>() {
            Ok(interrupted) => *interrupted,
            Err(panic) => resume_unwind(panic),
        })
    }
}
