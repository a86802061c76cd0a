//! Computations that can be stopped from outside, between their steps.
//!
//! Methods, ensembles and searches call [`look`] between two steps to check if their computation
//! has been interrupted. If so, it ends by unwinding the stack, which [`interruptible`] catches, so
//! that functions in between need no code for it.

#[cfg(feature = "std")]
pub use self::watched::{Interrupted, interruptible};
#[cfg(feature = "std")]
pub(crate) use self::watched::{SharedWatcher, Watcher};

/// Ends the computation if it runs within [`interruptible`] and has been interrupted. Long loops
/// should call it. A call takes some nanoseconds, or one nanosecond outside of [`interruptible`].
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

    /// Time between two calls of the interruption function.
    const PAUSE: Duration = Duration::from_millis(20);

    /// Error: the computation was interrupted, and its results are lost.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Interrupted;

    impl fmt::Display for Interrupted {
        fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("the computation was interrupted")
        }
    }

    impl std::error::Error for Interrupted {}

    /// Flag and function by which a thread finds out if its computation has been interrupted.
    #[derive(Clone)]
    pub(crate) struct Watcher {
        is_over: Arc<AtomicBool>,
        /// Function that reports an interruption, and the time of its next call; only in the thread
        /// that started the computation.
        question: Option<(Arc<dyn Fn() -> bool>, Instant)>,
    }

    thread_local! {
        static OWN: RefCell<Option<Watcher>> = const { RefCell::new(None) };
    }

    /// Restores the thread's previous watcher when it is dropped.
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

        /// Returns the watcher that other threads of this thread's computation use; `None` if the
        /// computation cannot be interrupted.
        pub(crate) fn of_others() -> Option<SharedWatcher> {
            OWN.with(|own| {
                let is_over = own.borrow().as_ref()?.is_over.clone();
                Some(SharedWatcher(is_over))
            })
        }
    }

    /// Flag by which the other threads learn of an interruption.
    #[derive(Clone)]
    pub(crate) struct SharedWatcher(Arc<AtomicBool>);

    impl SharedWatcher {
        /// Runs a part of the computation on this thread, so that it can be interrupted.
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
        // The interruption function may start a computation on this thread.
        if let Some((is_over, ask)) = question {
            answer(&is_over, ask);
        }
    }

    #[cold]
    fn answer(is_over: &AtomicBool, ask: Option<Arc<dyn Fn() -> bool>>) {
        if ask.is_none_or(|ask| ask()) {
            is_over.store(true, Ordering::Relaxed);
            // No panic, so that nothing is written to standard error.
            resume_unwind(Box::new(Interrupted));
        }
    }

    /// Runs work that ends early once `is_unwanted` returns true. This thread calls that function
    /// about fifty times per second, during calls of [`look`](super::look); threads of an
    /// [`Ensemble`](crate::ensemble::Ensemble) end too.
    ///
    /// The work ends by unwinding. In a program that is built to abort instead of unwinding, the
    /// whole program ends.
    ///
    /// # Errors
    ///
    /// [`Interrupted`] if the work was ended early.
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
        // State changed by the work is dropped with it, or belongs to the caller, who gets the
        // error.
        let outcome = catch_unwind(AssertUnwindSafe(|| watcher.watch(work)));
        outcome.map_err(|cause| match cause.downcast::<Interrupted>() {
            Ok(interrupted) => *interrupted,
            Err(panic) => resume_unwind(panic),
        })
    }
}
