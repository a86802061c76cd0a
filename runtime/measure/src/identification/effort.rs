//! Work done by a search: its amount so far, its limit, and an observer that can end the search.

use core::cell::Cell;
use core::ops::ControlFlow;

use super::convergence::SearchFailure;
use branched_pendulum::system::{Ode, Workspace};

/// Largest number of evaluations of one link's acceleration in a search: for each time of the
/// record and each unknown, and in addition a fixed number.
const FOR_EACH: u64 = 15_000;
const AT_LEAST: u64 = 20_000_000;
/// Largest number of evaluations of the equations of motion in one segment: for each sample, and in
/// addition a fixed number. This is about thirty times what a motion needs; equations with
/// unphysical constants might need any number.
const OF_A_SAMPLE: u64 = 600;
const OF_A_SEGMENT: u64 = 12_000;
/// Number of evaluations of one link's acceleration between two calls of the observer within a
/// segment: about a millisecond of work.
const BETWEEN_CALLS: u64 = 10_000;

/// Progress of a search that is running.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchProgress {
    /// Fraction, from 0 to 1, of the largest allowed work that has been done.
    pub share: f64,
    /// Length of the segments that were solved last, in s.
    pub segment: f64,
    /// Root mean square of their residuals (model minus data), in rad; NaN before the first
    /// segments.
    pub rms: f64,
}

/// Observer of a search. It is called about once per millisecond while segments are integrated, and
/// before each of them, and can end the search by returning [`ControlFlow::Break`].
pub type SearchObserver<'a> = &'a dyn Fn(&SearchProgress) -> ControlFlow<()>;

/// Work of a search.
pub(super) struct Effort<'a> {
    observer: SearchObserver<'a>,
    limit: Cell<u64>,
    spent: Cell<u64>,
    /// Work at the last call of the observer.
    seen: Cell<u64>,
    /// Reason why the search must end, once there is one.
    end: Cell<Option<SearchFailure>>,
    progress: Cell<SearchProgress>,
}

impl<'a> Effort<'a> {
    /// Creates the work count of a search, with the limit for a record with this number of times
    /// and unknowns.
    pub(super) fn of(times: usize, unknowns: usize, observer: SearchObserver<'a>) -> Self {
        let data = times.saturating_mul(unknowns) as u64;
        Self::with_limit(
            AT_LEAST.saturating_add(data.saturating_mul(FOR_EACH)),
            observer,
        )
    }

    /// Creates a work count without limit, for an evaluation that ends by itself.
    pub(super) fn unbounded() -> Self {
        Self::with_limit(u64::MAX, &|_| ControlFlow::Continue(()))
    }

    fn with_limit(limit: u64, observer: SearchObserver<'a>) -> Self {
        Self {
            observer,
            limit: Cell::new(limit),
            spent: Cell::new(0),
            seen: Cell::new(0),
            end: Cell::new(None),
            progress: Cell::new(SearchProgress {
                share: 0.0,
                segment: f64::NAN,
                rms: f64::NAN,
            }),
        }
    }

    /// Returns the reason why the search must end, if there is one.
    pub(super) fn end(&self) -> Option<SearchFailure> {
        self.end.get()
    }

    pub(super) fn is_over(&self) -> bool {
        self.end.get().is_some()
    }

    /// Reports the segments that were solved last to the observer.
    pub(super) fn show(&self, segment: f64, rms: f64) {
        let progress = self.progress.get();
        self.progress.set(SearchProgress {
            segment,
            rms,
            ..progress
        });
    }

    /// Calls the observer. Returns false if the search must end.
    pub(super) fn may_continue(&self) -> bool {
        if self.is_over() {
            return false;
        }
        self.seen.set(self.spent.get());
        let limit = self.limit.get();
        let progress = SearchProgress {
            share: self.spent.get() as f64 / limit as f64,
            ..self.progress.get()
        };
        // Without a limit the search is over, and its result is being evaluated.
        if limit < u64::MAX && (self.observer)(&progress).is_break() {
            self.end.set(Some(SearchFailure::Interrupted));
        }
        !self.is_over()
    }

    /// Adds to the work count. Returns false if the limit is exceeded.
    fn spend(&self, evaluations: u64) -> bool {
        let spent = self.spent.get().saturating_add(evaluations);
        self.spent.set(spent);
        if spent > self.limit.get() && !self.is_over() {
            self.end.set(Some(SearchFailure::Exhausted));
        }
        match spent.saturating_sub(self.seen.get()) < BETWEEN_CALLS {
            true => !self.is_over(),
            false => self.may_continue(),
        }
    }

    /// Runs work that ends by itself without limit, even after the search has ended, to evaluate a
    /// result.
    pub(super) fn unlimited<R>(&self, work: impl FnOnce() -> R) -> R {
        let (end, limit) = (self.end.take(), self.limit.replace(u64::MAX));
        let (spent, seen) = (self.spent.get(), self.seen.get());
        let result = work();
        self.end.set(end);
        self.limit.set(limit);
        self.spent.set(spent);
        self.seen.set(seen);
        result
    }

    /// Runs work with a limit of `share` of the whole. If it is exhausted, it ends earlier than the
    /// search.
    pub(super) fn within<R>(&self, share: f64, work: impl FnOnce() -> R) -> R {
        let limit = self.limit.get();
        self.limit.set((share * limit as f64) as u64);
        let result = work();
        self.limit.set(limit);
        if self.end() == Some(SearchFailure::Exhausted) {
            self.end.set(None);
        }
        result
    }
}

/// Equations of motion whose evaluations are counted. They return NaN after too many evaluations.
pub(super) struct Counted<'a> {
    system: &'a dyn Ode<f64>,
    effort: &'a Effort<'a>,
    /// Number of evaluations of one link that an evaluation of the system counts as.
    weight: u64,
    left: Cell<u64>,
}

impl<'a> Counted<'a> {
    /// Wraps the equations for a segment with this number of samples.
    pub(super) fn new(
        system: &'a dyn Ode<f64>,
        effort: &'a Effort<'a>,
        weight: u64,
        samples: usize,
    ) -> Self {
        let left = Cell::new(OF_A_SEGMENT + OF_A_SAMPLE * samples as u64);
        Self {
            system,
            effort,
            weight,
            left,
        }
    }

    fn is_allowed(&self) -> bool {
        let left = self.left.get();
        self.left.set(left.saturating_sub(1));
        left > 0 && self.effort.spend(self.weight)
    }
}

impl Ode<f64> for Counted<'_> {
    fn dimension(&self) -> usize {
        self.system.dimension()
    }

    fn rates(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.rates_with(&mut Workspace::new(), time, state, rates);
    }

    fn rates_with(
        &self,
        workspace: &mut Workspace<f64>,
        time: f64,
        state: &[f64],
        rates: &mut [f64],
    ) {
        match self.is_allowed() {
            true => self.system.rates_with(workspace, time, state, rates),
            false => rates.fill(f64::NAN),
        }
    }
}
