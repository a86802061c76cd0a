//! Methods at work: their memory, and how they make a step.

// A sealed trait names the types.
#![allow(unreachable_pub)]

use super::checkpoint::Memory;
use super::error::IntegrationError;
use super::evaluator::{Evaluator, NonFinite};
use super::options::Options;
use super::piece::Piece;
use super::report::{Report, StopReason};
use crate::scalar::Real;
use crate::system::State;

/// A method at work: its memory and its step control.
///
/// A step lies between two states, both of which stay until
/// [`advance`](Self::advance) makes the end the start of the next one.
pub trait Steps<T: Real, O: ?Sized> {
    /// Makes the next step, from `time` towards the goal. Returns the time of its end.
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>>;

    /// Computes what values inside the step that was made from `time` need.
    fn prepare(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        let _ = (system, time);
        Ok(())
    }

    /// The step: its ends, and the polynomial between them.
    fn piece(&self) -> Piece<'_, T>;

    /// Makes the end of the step the start of the next.
    fn advance(&mut self);

    /// Starts anew from `values`, in a motion that need not be that of the steps
    /// before.
    fn restart(&mut self, values: &[T]);

    /// Saves what the next step depends on, beside the state at its start, or restores
    /// it.
    fn remember(&mut self, memory: &mut Memory<T>);
}

/// Where steps lead.
#[derive(Clone, Copy, Debug)]
pub struct Goal<T> {
    /// Time beyond which no step may go, if there is one.
    pub(crate) end: Option<T>,
    /// 1, or −1 backwards.
    pub(crate) direction: T,
    /// Steps of earlier requests, which do not count towards a limit of this one.
    pub(crate) steps_before: u64,
}

/// Longest step where neither the goal nor the options set a limit: a system at
/// rest would make infinite ones.
const FARTHEST: f64 = 1e6;

impl<T: Real> Goal<T> {
    /// Length of time from `time` on.
    pub(crate) fn distance(&self, time: T) -> T {
        self.end
            .map_or(T::from_f64(FARTHEST), |end| (end - time).abs())
    }

    /// End of a step from `time` of the length `step`, and true if it is the goal.
    #[inline(always)]
    pub(crate) fn plan(&self, time: T, step: T) -> (T, bool) {
        match self.end {
            Some(end) => towards(end, self.direction, time, step),
            None => {
                let step = step.min(T::from_f64(FARTHEST));
                (time + self.direction * step, false)
            }
        }
    }
}

/// End of a step from `time` of the length `step` towards `end`, and true if that is
/// reached. A step one per cent longer than planned is better than a sliver at the end.
#[inline(always)]
pub(crate) fn towards<T: Real>(end: T, direction: T, time: T, step: T) -> (T, bool) {
    let last = step * T::from_f64(1.01) >= (end - time).abs();
    let next = time + direction * step;
    (if last { end } else { next }, last)
}

/// The limits that options set to steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepLimits<T> {
    /// Length of the first step that is tried.
    pub(crate) initial: Option<T>,
    /// Longest step.
    pub(crate) longest: Option<T>,
    /// Shortest step, but for the last one.
    shortest: T,
    /// Number of steps, accepted and rejected together.
    number: u64,
}

impl<T: Real> StepLimits<T> {
    pub(crate) fn new(options: &Options<T>) -> Self {
        Self {
            initial: options.initial_step,
            longest: options.max_step,
            shortest: options.min_step,
            number: options.step_limit,
        }
    }

    /// The step, or the longest one allowed.
    pub(crate) fn limit(&self, step: T) -> T {
        self.longest.map_or(step, |longest| step.min(longest))
    }

    /// The longest step that a method without a control of its own may take; the `first`
    /// one is no longer than the initial step that was asked for.
    pub(crate) fn bound(&self, first: bool) -> T {
        let longest = self.longest.unwrap_or(T::ONE / T::ZERO);
        let initial = self.initial.filter(|_| first);
        initial.map_or(longest, |initial| initial.min(longest))
    }

    /// Below this length, time plus step is mostly rounding.
    #[inline(always)]
    fn lost(time: T) -> T {
        T::from_f64(10.0) * T::EPSILON * time.abs()
    }

    /// Returns true if a step from `time` of length `step` may be tried after so many others;
    /// `last` if it reaches the end, which may be as near as it likes.
    #[inline(always)]
    pub(crate) fn allow(&self, steps: u64, (time, step, last): (T, T, bool)) -> bool {
        let short = (step < self.shortest) | (step <= Self::lost(time));
        (steps < self.number) & (last | !short)
    }

    /// Passes such a step in a run with this account.
    #[inline(always)]
    pub(crate) fn check(
        &self,
        report: &Report<T>,
        steps_before: u64,
        attempt: (T, T, bool),
    ) -> Result<(), Failure<T>> {
        let steps = report.accepted + report.rejected - steps_before;
        if self.allow(steps, attempt) {
            return Ok(());
        }
        check_number(self.number, report, steps_before)?;
        let (time, step, _) = attempt;
        Err(Failure::StepTooSmall {
            step,
            shortest: self.shortest.max(Self::lost(time)),
        })
    }
}

/// Passes one step more in a run with this account.
#[inline(always)]
pub(crate) fn check_number<T: Real>(
    limit: u64,
    report: &Report<T>,
    steps_before: u64,
) -> Result<(), Failure<T>> {
    if report.accepted + report.rejected - steps_before >= limit {
        return Err(Failure::StepLimit { limit });
    }
    Ok(())
}

/// Why a step was not made.
#[derive(Clone, Debug)]
pub enum Failure<T> {
    /// Rates or state were not finite.
    NonFinite(NonFinite<T>),
    /// The tolerances ask for a step below the shortest allowed.
    StepTooSmall { step: T, shortest: T },
    /// The limit on the number of steps was reached.
    StepLimit { limit: u64 },
    /// The equations of the step were not solved.
    NotSolved { step: T, iterations: u32, change: T },
    /// The end of the step was not projected onto the level of the integral.
    NotProjected {
        step: T,
        iterations: u32,
        deviation: T,
    },
}

impl<T> From<NonFinite<T>> for Failure<T> {
    fn from(place: NonFinite<T>) -> Self {
        Self::NonFinite(place)
    }
}

impl<T: Real> Failure<T> {
    /// The error of a run that ends here; `last` is its last good state.
    #[cold]
    pub(crate) fn error(self, last: State<T>, report: &Report<T>) -> IntegrationError<T> {
        let report = |stop| Report { stop, ..*report };
        match self {
            Self::NonFinite(NonFinite { time, values }) => IntegrationError::NonFinite {
                time,
                values,
                last,
                report: report(StopReason::NonFinite),
            },
            Self::StepTooSmall { step, shortest } => IntegrationError::StepTooSmall {
                step,
                shortest,
                last,
                report: report(StopReason::StepTooSmall),
            },
            Self::StepLimit { limit } => IntegrationError::StepLimit {
                limit,
                last,
                report: report(StopReason::StepLimit),
            },
            Self::NotSolved {
                step,
                iterations,
                change,
            } => IntegrationError::NotSolved {
                step,
                iterations,
                change,
                last,
                report: report(StopReason::NotSolved),
            },
            Self::NotProjected {
                step,
                iterations,
                deviation,
            } => IntegrationError::NotProjected {
                step,
                iterations,
                deviation,
                last,
                report: report(StopReason::NotProjected),
            },
        }
    }
}
