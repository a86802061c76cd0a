//! Report of a run: steps, evaluations, and the reason for its end.

use core::fmt;

use crate::scalar::Real;
use crate::system::State;

/// Reason why a run stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum StopReason {
    /// The run reached the end of its time span.
    EndReached,
    /// The observer ended the run.
    StoppedByObserver,
    /// A terminal event ended the run.
    StoppedByEvent,
    /// The limit on the number of steps was reached.
    StepLimit,
    /// The tolerances required a step below the shortest step.
    StepTooSmall,
    /// The equations of an implicit step could not be solved.
    NotSolved,
    /// A state could not be projected to the level of a first integral.
    NotProjected,
    /// The state or its rates became infinite or NaN.
    NonFinite,
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::EndReached => "end reached",
            Self::StoppedByObserver => "stopped by the observer",
            Self::StoppedByEvent => "stopped at an event",
            Self::StepLimit => "step limit reached",
            Self::StepTooSmall => "step too small",
            Self::NotSolved => "equations of a step not solved",
            Self::NotProjected => "state not projected",
            Self::NonFinite => "state or rates not finite",
        })
    }
}

/// Report of a run: its steps, its evaluations, and the reason why it stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report<T> {
    /// Number of accepted steps.
    pub accepted: u64,
    /// Number of steps rejected because their error was too large or their equations could not be
    /// solved.
    pub rejected: u64,
    /// Number of evaluations of the right-hand side, including those for the first step and the
    /// dense output.
    pub evaluations: u64,
    /// Length of the shortest accepted step; zero before the first one.
    pub shortest_step: T,
    /// Length of the longest accepted step; zero before the first one.
    pub longest_step: T,
    /// Length of the step that the step-size control would try next, for use as the initial step of
    /// a continuation. Zero if no step was tried.
    pub next_step: T,
    /// Why the run stopped.
    pub stop: StopReason,
}

impl<T: Real> Report<T> {
    pub(crate) fn new() -> Self {
        Self {
            accepted: 0,
            rejected: 0,
            evaluations: 0,
            shortest_step: T::ZERO,
            longest_step: T::ZERO,
            next_step: T::ZERO,
            stop: StopReason::EndReached,
        }
    }

    /// Counts an accepted step of length `step`.
    pub(crate) fn accept(&mut self, step: T) {
        let before = [self.shortest_step, self.longest_step];
        [self.shortest_step, self.longest_step] = extremes(before, self.accepted == 0, step);
        self.accepted += 1;
    }
}

/// Returns the shortest and the longest step, updated by one more step, which may be the first.
#[inline(always)]
pub(crate) fn extremes<T: Real>([shortest, longest]: [T; 2], first: bool, step: T) -> [T; 2] {
    let shorter = first | (step < shortest);
    [if shorter { step } else { shortest }, longest.max(step)]
}

impl<T: Real> fmt::Display for Report<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            accepted,
            rejected,
            evaluations,
            shortest_step,
            longest_step,
            next_step: _,
            stop,
        } = self;
        write!(
            f,
            "{stop}: {accepted} steps of {shortest_step:.3e} to {longest_step:.3e}, \
             {rejected} rejected, {evaluations} evaluations",
            shortest_step = shortest_step.to_f64(),
            longest_step = longest_step.to_f64(),
        )
    }
}

/// Last state and report of a run.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solution<T> {
    /// State at the end of the time span, or at the step or event at which the run was stopped.
    pub state: State<T>,
    /// Report of the run.
    pub report: Report<T>,
}
