//! The account that a run leaves.

use core::fmt;

use crate::scalar::Real;
use crate::system::State;

/// Why a run stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum StopReason {
    /// The end of the span was reached.
    EndReached,
    /// The observer asked to stop.
    StoppedByObserver,
    /// An event was found at which the run was to end.
    StoppedByEvent,
    /// The limit on the number of steps was reached.
    StepLimit,
    /// A step below the shortest allowed was called for.
    StepTooSmall,
    /// The equations of an implicit step could not be solved.
    NotSolved,
    /// A state could not be brought back to the level of a first integral.
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

/// The account of a run: its steps, its evaluations, and why it stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report<T> {
    /// Steps accepted.
    pub accepted: u64,
    /// Steps rejected because their error was too large, or because their
    /// equations could not be solved.
    pub rejected: u64,
    /// Evaluations of the right-hand side, those for the first step and for
    /// the dense output included.
    pub evaluations: u64,
    /// Length of the shortest step accepted; zero before the first one.
    pub shortest_step: T,
    /// Length of the longest step accepted; zero before the first one.
    pub longest_step: T,
    /// Length of the step that the control would take next: the initial step
    /// for a continuation. Zero where no step was tried.
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

/// The shortest and the longest step with one more, which may be the first.
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

/// Where a run ended, and its account.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solution<T> {
    /// The last state: at the end of the span, where the observer stopped, or
    /// at the event that ended the run.
    pub state: State<T>,
    /// The account of the run.
    pub report: Report<T>,
}
