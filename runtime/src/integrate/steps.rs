//! Interface of a method during a run: its data, and its steps.

// The types are public because a sealed trait mentions them.
#![allow(unreachable_pub)]

use super::checkpoint::Memory;
use super::error::IntegrationError;
use super::evaluator::{Evaluator, NonFinite};
use super::options::Options;
use super::piece::Piece;
use super::report::{Report, StopReason};
use crate::scalar::Real;
use crate::system::State;

/// Data of a method during a run, including its step-size control.
///
/// A step lies between two states, which both stay available until [`advance`](Self::advance) makes
/// the end the start of the next step.
pub trait Steps<T: Real, O: ?Sized> {
    /// Makes the next step, from `time` towards the goal, and returns the time at its end.
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>>;

    /// Computes the dense output of the step that started at `time`.
    fn prepare(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), NonFinite<T>> {
        let _ = (system, time);
        Ok(())
    }

    /// Returns the step: its ends, and the polynomial between them.
    fn piece(&self) -> Piece<'_, T>;

    /// Makes the end of the step the start of the next step.
    fn advance(&mut self);

    /// Restarts from the state `values`, which may belong to another motion.
    fn restart(&mut self, values: &[T]);

    /// Saves or restores the numbers on which the next step depends, in addition to the state at
    /// its start.
    fn remember(&mut self, memory: &mut Memory<T>);
}

/// Direction of a run in time, and its end.
#[derive(Clone, Copy, Debug)]
pub struct Goal<T> {
    /// Time that no step may pass, if there is one.
    pub(crate) end: Option<T>,
    /// Direction of the run: 1 forwards, −1 backwards in time.
    pub(crate) direction: T,
    /// Number of steps of earlier calls, which do not count towards the step limit of this one.
    pub(crate) steps_before: u64,
}

/// Longest step if neither the goal nor the options set a limit, because a system at rest would
/// allow infinite steps.
const FARTHEST: f64 = 1e6;

impl<T: Real> Goal<T> {
    /// Returns the absolute time between `time` and the end.
    pub(crate) fn distance(&self, time: T) -> T {
        self.end
            .map_or(T::from_f64(FARTHEST), |end| (end - time).abs())
    }

    /// Returns the end time of a step of length `step` from `time`, and true if this is the end of
    /// the run.
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

/// Returns the end time of a step of length `step` from `time` towards `end`, and true if `end` is
/// reached. The step may be one per cent longer than planned, to avoid a tiny last step.
#[inline(always)]
pub(crate) fn towards<T: Real>(end: T, direction: T, time: T, step: T) -> (T, bool) {
    let last = step * T::from_f64(1.01) >= (end - time).abs();
    let next = time + direction * step;
    (if last { end } else { next }, last)
}

/// Limits on the length and number of steps, from the options.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepLimits<T> {
    /// Length of the first step to try.
    pub(crate) initial: Option<T>,
    /// Longest step.
    pub(crate) longest: Option<T>,
    /// Shortest step; the last step may be shorter.
    shortest: T,
    /// Largest number of steps, accepted and rejected.
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

    /// Returns the step length, reduced to the longest allowed step if it exceeds it.
    pub(crate) fn limit(&self, step: T) -> T {
        self.longest.map_or(step, |longest| step.min(longest))
    }

    /// Returns the longest allowed step of a method that does not control its error by the step
    /// length; the `first` step is at most the initial step of the options.
    pub(crate) fn bound(&self, first: bool) -> T {
        let longest = self.longest.unwrap_or(T::ONE / T::ZERO);
        let initial = self.initial.filter(|_| first);
        initial.map_or(longest, |initial| initial.min(longest))
    }

    /// Returns the length below which time + step is dominated by the rounding of the time.
    #[inline(always)]
    fn lost(time: T) -> T {
        T::from_f64(10.0) * T::EPSILON * time.abs()
    }

    /// Returns true if one more step, from `time` with length `step`, is allowed after `steps`
    /// steps. `last` marks a step that reaches the end, which may have any length.
    #[inline(always)]
    pub(crate) fn allow(&self, steps: u64, (time, step, last): (T, T, bool)) -> bool {
        let short = (step < self.shortest) | (step <= Self::lost(time));
        (steps < self.number) & (last | !short)
    }

    /// Checks that a step is allowed after the steps in the report; `attempt` is the step's start,
    /// its length, and true if it is the last one.
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

/// Checks that the limit on the number of steps allows one more step.
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

/// Reason why a step could not be made.
#[derive(Clone, Debug)]
pub enum Failure<T> {
    /// Rates or state were not finite.
    NonFinite(NonFinite<T>),
    /// The tolerances require a step below the shortest step.
    StepTooSmall { step: T, shortest: T },
    /// The limit on the number of steps was reached.
    StepLimit { limit: u64 },
    /// The equations of the step could not be solved.
    NotSolved { step: T, iterations: u32, change: T },
    /// The end of the step could not be projected to the level of the integral.
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
    /// Converts the failure to the error of the run; `last` is its last good state.
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
