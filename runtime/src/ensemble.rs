//! Many trajectories at once, on all cores.
//!
//! An [`Ensemble`] hands items (initial conditions, parameter sets) to threads,
//! one after the other, and gives the results back in the order of the items.
//! What a result is is the caller's choice; an item that fails with an error
//! is one `Err` among the results, and the others run on.
//!
//! A trajectory is computed by one thread from its own input alone, so that
//! results are the same bit for bit, whatever the number of threads.

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::slice::ChunksExact;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crate::integrate::lanes::{self, Outcome, Task};
use crate::integrate::{DenseStep, IntegrationError, Integrator, LaneMethod, Solution};
use crate::scalar::{InstructionSet, Lane, Real};
use crate::system::{Ode, Rescale, State};

/// How an ensemble is computed.
///
/// # Examples
///
/// Where a hundred pendulums are after ten seconds, one of which starts from
/// nowhere:
///
/// ```
/// use branched_pendulum::ensemble::Ensemble;
/// use branched_pendulum::prelude::*;
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
    /// On as many threads as the system offers, without progress.
    pub fn new() -> Self {
        Self {
            threads: None,
            progress: None,
        }
    }

    /// On so many threads, though not more than there are items.
    pub fn threads(self, threads: NonZeroUsize) -> Self {
        Self {
            threads: Some(threads),
            ..self
        }
    }

    /// Calls `progress` with the number of items done, after each, from the
    /// thread that did it: numbers may arrive out of order.
    pub fn progress(self, progress: &'a (dyn Fn(usize) + Sync)) -> Self {
        Self {
            progress: Some(progress),
            ..self
        }
    }

    /// `work(index, item)` for every item; results in the order of the items.
    ///
    /// Items are handed out one at a time, so that long ones do not wait for
    /// each other. A panic in `work` ends the whole call with that panic: what
    /// can fail should return an error.
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

    /// Runs `worker` on every thread, for results in the order of their indices.
    fn on_threads<R: Send>(
        &self,
        items: usize,
        worker: impl Fn(&Queue<'_>) -> Vec<(usize, R)> + Sync,
    ) -> Vec<R> {
        let queue = Queue {
            items,
            next: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
            progress: self.progress,
        };
        let worker = || worker(&queue);
        let threads = self
            .threads
            .or_else(|| thread::available_parallelism().ok())
            .map_or(1, NonZeroUsize::get)
            .min(items);
        let mut results: Vec<(usize, R)> = thread::scope(|scope| {
            // This thread works too.
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(worker)).collect();
            let mut results = worker();
            for other in others {
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
        let run_on = |_: &mut DenseStep<'_, T>| std::ops::ControlFlow::Continue(());
        self.map(starts, |_, start| method.integrate(ode, start, end, run_on))
    }

    /// Integrates a pendulum from every start to the time `end`, as many starts
    /// at a time on each thread as the widest vector registers of the machine
    /// have lanes: eight in `f64` with AVX-512.
    ///
    /// By [`Taylor`](crate::integrate::Taylor), for models that say `emit(taylor)`,
    /// or by [`Dop853`](crate::integrate::Dop853).
    ///
    /// States are absolute angles (rad), then angular velocities (rad/s), as for
    /// [`AbsoluteAngles`](crate::system::AbsoluteAngles). Each trajectory has its own steps, chosen by the rules
    /// of `method` from its own errors, and its own errors and account, as
    /// [`integrate`](Self::integrate) gives them. Its bits depend on its start
    /// alone: not on its place, the other starts or the number of threads. They
    /// are not those of [`integrate`](Self::integrate), because products and sums
    /// are fused here where the machine can; both keep the tolerance. A lane whose
    /// trajectory has ended takes the next start.
    ///
    /// Memory on each thread: 30 registers for each component of a state, and for a
    /// Taylor series of order p some 20 + 4 p; steps allocate nothing.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::ensemble::Ensemble;
    /// use branched_pendulum::prelude::*;
    ///
    /// /// A uniform rod, as the attribute writes trees; holds 3 g / (2 length).
    /// struct Rod<T>(T);
    ///
    /// impl<T: Scalar> Pendulum<T> for Rod<T> {
    ///     const LINKS: usize = 1;
    ///     const LINK_NAMES: &'static [&'static str] = &["rod"];
    ///
    ///     fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
    ///         T::accelerate(self, time, theta, omega, alpha);
    ///     }
    /// }
    ///
    /// impl<T: Scalar> Rescale<T> for Rod<T> {
    ///     type Of<S: Scalar> = Rod<S>;
    ///
    ///     fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
    ///         Rod(convert(self.0))
    ///     }
    ///
    ///     #[inline(always)]
    ///     fn evaluate(
    ///         &self,
    ///         _time: T,
    ///         theta: impl Fn(usize) -> T,
    ///         _omega: impl Fn(usize) -> T,
    ///         mut alpha: impl FnMut(usize, T),
    ///     ) {
    ///         alpha(0, -(self.0 * theta(0).sin_cos().0));
    ///     }
    /// }
    ///
    /// let rod = Rod(1.5 * 9.80665);
    /// let starts: Vec<State<f64>> = (1..100)
    ///     .map(|i| State::at_rest(0.0, &[0.03 * f64::from(i)]))
    ///     .collect();
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let lanes = Ensemble::new().integrate_in_lanes(&method, &rod, &starts, 10.0);
    /// let plain = Ensemble::new().integrate(&method, &AbsoluteAngles(&rod), &starts, 10.0);
    /// for (lane, plain) in lanes.into_iter().zip(plain) {
    ///     let (lane, plain) = (lane?.state.values[0], plain?.state.values[0]);
    ///     assert!((lane - plain).abs() < 1e-7);
    /// }
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    pub fn integrate_in_lanes<T, P, M>(
        &self,
        method: &M,
        pendulum: &P,
        starts: &[State<T>],
        end: T,
    ) -> Vec<Result<Solution<T>, IntegrationError<T>>>
    where
        T: Lane,
        P: Rescale<T> + Sync,
        M: LaneMethod<P, T>,
    {
        let task = Task {
            instructions: InstructionSet::widest(),
            method,
            pendulum,
            starts,
            times: &[],
            end: Some(end),
        };
        let outcomes = self.in_lanes(&task);
        outcomes.into_iter().map(|outcome| outcome.end).collect()
    }

    /// The states of a pendulum at the given times, from every start, in lanes as
    /// [`integrate_in_lanes`](Self::integrate_in_lanes).
    ///
    /// Times run one way from every start; those equal to it give the start itself.
    /// The steps are those of [`integrate_in_lanes`](Self::integrate_in_lanes) to the
    /// last time: states between their ends come from the dense output of the
    /// method, in lanes too. Without times the end is the start.
    ///
    /// Memory: beside that of the steps, one state for each time and start.
    ///
    /// # Examples
    ///
    /// Where a trajectory fails, its samples end, and no other is concerned:
    ///
    /// ```
    /// # use branched_pendulum::ensemble::Ensemble;
    /// # use branched_pendulum::prelude::*;
    /// # struct Rod<T>(T);
    /// # impl<T: Scalar> Pendulum<T> for Rod<T> {
    /// #     const LINKS: usize = 1;
    /// #     const LINK_NAMES: &'static [&'static str] = &["rod"];
    /// #     fn accelerations_into(&self, time: T, theta: &[T], omega: &[T], alpha: &mut [T]) {
    /// #         T::accelerate(self, time, theta, omega, alpha);
    /// #     }
    /// # }
    /// # impl<T: Scalar> Rescale<T> for Rod<T> {
    /// #     type Of<S: Scalar> = Rod<S>;
    /// #     fn rescale<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
    /// #         Rod(convert(self.0))
    /// #     }
    /// #     #[inline(always)]
    /// #     fn evaluate(
    /// #         &self,
    /// #         _time: T,
    /// #         theta: impl Fn(usize) -> T,
    /// #         _omega: impl Fn(usize) -> T,
    /// #         mut alpha: impl FnMut(usize, T),
    /// #     ) {
    /// #         alpha(0, -(self.0 * theta(0).sin_cos().0));
    /// #     }
    /// # }
    /// let rod = Rod(14.7);
    /// let starts = [0.1, f64::NAN, 0.2].map(|angle| State::at_rest(0.0, &[angle]));
    /// let times: Vec<f64> = (0..=100).map(|i| 0.1 * f64::from(i)).collect();
    /// let method = Dop853::new(Options::with_tolerance(1e-10));
    /// let samples = Ensemble::new().sample_in_lanes(&method, &rod, &starts, &times);
    /// assert_eq!(samples[0].states().len(), 101);
    /// assert_eq!(samples[0].states().next(), Some([0.1, 0.0].as_slice()));
    /// assert_eq!(samples[1].states().len(), 0);
    /// assert!(samples[1].end.is_err() && samples[2].end.is_ok());
    /// ```
    pub fn sample_in_lanes<T, P, M>(
        &self,
        method: &M,
        pendulum: &P,
        starts: &[State<T>],
        times: &[T],
    ) -> Vec<Samples<T>>
    where
        T: Lane,
        P: Rescale<T> + Sync,
        M: LaneMethod<P, T>,
    {
        let task = Task {
            instructions: InstructionSet::widest(),
            method,
            pendulum,
            starts,
            times,
            end: times.last().copied(),
        };
        let outcomes = self.in_lanes(&task).into_iter();
        outcomes
            .map(|Outcome { end, samples }| Samples {
                dimension: 2 * P::LINKS,
                values: samples,
                end,
            })
            .collect()
    }

    fn in_lanes<T, P, M>(&self, task: &Task<'_, M, P, T>) -> Vec<Outcome<T>>
    where
        T: Lane,
        P: Rescale<T> + Sync,
        M: LaneMethod<P, T>,
    {
        self.on_threads(task.starts.len(), |queue| {
            let mut results = Vec::new();
            let done = |index, outcome| {
                results.push((index, outcome));
                queue.done();
            };
            lanes::integrate(task, || queue.next(), done);
            results
        })
    }
}

/// A trajectory at given times.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples<T> {
    dimension: usize,
    values: Vec<T>,
    /// Where it ended, or why it did before.
    pub end: Result<Solution<T>, IntegrationError<T>>,
}

impl<T> Samples<T> {
    /// The states at the times asked for, in their order: one for each time, or for
    /// those up to the last good state where the trajectory failed, unless the
    /// rates were not finite within its last step.
    pub fn states(&self) -> ChunksExact<'_, T> {
        self.values.chunks_exact(self.dimension.max(1))
    }
}

/// The items that no thread has taken yet, and the number of those done.
struct Queue<'a> {
    items: usize,
    next: AtomicUsize,
    done: AtomicUsize,
    progress: Option<&'a (dyn Fn(usize) + Sync)>,
}

// The counters carry no data: relaxed order suffices.
impl Queue<'_> {
    /// The index of an item that is this thread's from now on.
    fn next(&self) -> Option<usize> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.items).then_some(index)
    }

    /// Counts an item that is done.
    fn done(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(progress) = self.progress {
            progress(done);
        }
    }
}
