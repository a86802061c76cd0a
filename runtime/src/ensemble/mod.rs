//! Many trajectories at once, on all cores.
//!
//! An [`Ensemble`] distributes items (initial conditions, parameter sets) to threads one by one,
//! and returns the results in the order of the items. The caller chooses the type of a result. An
//! item that fails with an error is one `Err` among the results; the others continue.
//!
//! Models can be integrated in the lanes of vector registers, several trajectories at a time on
//! each thread: many starts of one system ([`Ensemble::integrate_in_lanes`]) or systems that differ
//! in their constants ([`Ensemble::integrate_models_in_lanes`]).
//!
//! A trajectory is computed by one thread from its own input alone, so that the results are
//! identical bit for bit for any number of threads.

mod lanes;
mod queue;

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::thread;

pub use self::lanes::Samples;
use self::queue::Queue;
use crate::integrate::{IntegrationError, Integrator, Solution};
use crate::interruption::{self, SharedWatcher, Watcher};
use crate::scalar::Real;
use crate::system::{Ode, State};

/// Interval at which a waiting thread checks if the others have finished.
const CHECK_INTERVAL: std::time::Duration = std::time::Duration::from_micros(200);

/// Computation of an ensemble.
///
/// # Examples
///
/// Positions of a hundred pendulums after ten seconds, one of which starts from
/// nowhere:
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let pendulum = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0].sin();
/// });
/// let starts: Vec<State<f64>> = (0..100)
///     .map(|i| State::at_rest(0.0, &[if i == 50 { f64::NAN } else { 0.01 * f64::from(i) }]))
///     .collect();
/// let method = Dop853::new(Options::with_tolerance(1e-10));
/// let ends = Ensemble::new().integrate(&method, &pendulum, &starts, 10.0);
/// assert_eq!(ends.iter().filter(|end| end.is_ok()).count(), 99);
/// assert!(matches!(ends[50], Err(IntegrationError::Input(_))));
/// ```
#[derive(Clone, Copy)]
pub struct Ensemble<'a> {
    threads: Option<NonZeroUsize>,
    progress: Option<&'a (dyn Fn(usize) + Sync)>,
}

impl std::fmt::Debug for Ensemble<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            threads,
            progress: _,
        } = self;
        formatter
            .debug_struct("Ensemble")
            .field("threads", threads)
            .finish_non_exhaustive()
    }
}

impl Default for Ensemble<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> Ensemble<'a> {
    /// Creates an ensemble that uses as many threads as the system offers, without a progress
    /// function.
    pub fn new() -> Self {
        Self {
            threads: None,
            progress: None,
        }
    }

    /// Uses at most `threads` threads. At most as many threads are used as the system offers,
    /// because more would not be faster, and at most one per item.
    pub fn threads(self, threads: NonZeroUsize) -> Self {
        Self {
            threads: Some(threads),
            ..self
        }
    }

    /// Calls `progress` with the number of finished items after each item, from the thread that
    /// finished it. Numbers may arrive out of order.
    pub fn progress(self, progress: &'a (dyn Fn(usize) + Sync)) -> Self {
        Self {
            progress: Some(progress),
            ..self
        }
    }

    /// Computes `work(index, item)` for every item; returns the results in the order of the items.
    ///
    /// Items are distributed one at a time, so that threads stay busy if items take different
    /// times. A panic in `work` ends the whole call with that panic; work that can fail should
    /// return an error.
    pub fn map<I: Sync, R: Send>(
        &self,
        items: &[I],
        work: impl Fn(usize, &I) -> R + Sync,
    ) -> Vec<R> {
        self.on_threads(items.len(), |queue| {
            let mut results = Vec::new();
            while let Some(index) = queue.next() {
                if let Some(item) = items.get(index) {
                    results.push((index, work(index, item)));
                    queue.done();
                }
            }
            results
        })
    }

    /// Runs `worker` on every thread; returns all results in the order of the items' indices.
    fn on_threads<R: Send>(
        &self,
        items: usize,
        worker: impl Fn(&Queue<'_>) -> Vec<(usize, R)> + Sync,
    ) -> Vec<R> {
        let queue = Queue::new(items, self.progress);
        let worker = || worker(&queue);
        let offered = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let threads = self
            .threads
            .unwrap_or(offered)
            .min(offered)
            .get()
            .min(items);
        let mut results: Vec<(usize, R)> = thread::scope(|scope| {
            // This thread works too.
            let watcher = Watcher::of_others();
            let watched = |watcher: Option<SharedWatcher>| match watcher {
                Some(watcher) => watcher.watch(worker),
                None => worker(),
            };
            let others: Vec<_> = (1..threads)
                .map(|_| watcher.clone())
                .map(|watcher| scope.spawn(move || watched(watcher)))
                .collect();
            let mut results = worker();
            for other in others {
                while watcher.is_some() && !other.is_finished() {
                    thread::sleep(CHECK_INTERVAL);
                    interruption::look();
                }
                match other.join() {
                    Ok(more) => results.extend(more),
                    Err(panic) => resume_unwind(panic),
                }
            }
            results
        });
        results.sort_unstable_by_key(|&(index, _)| index);
        results.into_iter().map(|(_, result)| result).collect()
    }

    /// Integrates the same system from every start to the time `end`.
    pub fn integrate<T, O, M>(
        &self,
        method: &M,
        ode: &O,
        starts: &[State<T>],
        end: T,
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Real + Send + Sync,
        O: Ode<T> + Sync + ?Sized,
        M: Integrator<T, O> + Sync,
    {
        self.map(starts, |_, start| method.run(ode, start, end))
    }
}
