//! A run under way: what it works on, its account, and its ends.

use super::arithmetic::NonFiniteRates;
use super::memory::Memory;
use super::pair::Pair;
use crate::integrate::error::IntegrationError;
use crate::integrate::options::Options;
use crate::integrate::report::{Report, Solution, StopReason};
use crate::scalar::Real;
use crate::system::{Ode, State};

/// A run under way.
pub(super) struct Run<'a, T, O: ?Sized> {
    pub(super) ode: &'a O,
    pub(super) memory: Memory<T>,
    pub(super) time: T,
    pub(super) report: Report<T>,
}

impl<'a, T: Real, O: ?Sized> Run<'a, T, O> {
    /// A run of `ode` about to leave `start`.
    pub(super) fn new<M: Pair>(ode: &'a O, options: &Options<T>, start: &State<T>) -> Self {
        Self {
            ode,
            memory: Memory::new::<M>(options, &start.values),
            time: start.time,
            report: Report::new(),
        }
    }

    /// Rates at the end of the step, at time `time`.
    pub(super) fn evaluate_end<M: Pair>(&mut self, time: T) -> Result<(), IntegrationError<T>>
    where
        O: Ode<T>,
    {
        self.report.evaluations += 1;
        self.memory
            .evaluate_end(self.ode, time, M::STAGES + 1)
            .map_err(|rates| self.non_finite(rates))
    }

    /// Whether a step of length `step` may be tried; `last` if it reaches the
    /// end.
    pub(super) fn check_step(
        &self,
        options: &Options<T>,
        step: T,
        last: bool,
    ) -> Result<(), IntegrationError<T>> {
        check_step(options, &self.report, (self.time, step, last), || {
            self.state()
        })
    }

    /// The last accepted state.
    pub(super) fn state(&self) -> State<T> {
        State {
            time: self.time,
            values: self.memory.start.clone(),
        }
    }

    /// The error for rates that are not finite, at the state of the stage.
    pub(super) fn non_finite(&self, rates: NonFiniteRates<T>) -> IntegrationError<T> {
        IntegrationError::NonFinite {
            time: rates.time,
            values: self.memory.stage.clone(),
            last: self.state(),
            report: Report {
                stop: StopReason::NonFinite,
                ..self.report
            },
        }
    }

    /// The end of a run that went well.
    pub(super) fn solution(self, stop: StopReason) -> Solution<T> {
        Solution {
            state: State {
                time: self.time,
                values: self.memory.start,
            },
            report: Report {
                stop,
                ..self.report
            },
        }
    }
}

/// Whether a run with this account may try a step from `time` of length `step`;
/// `last` if it reaches the end. `state` is the last accepted one.
pub(crate) fn check_step<T: Real>(
    options: &Options<T>,
    report: &Report<T>,
    (time, step, last): (T, T, bool),
    state: impl FnOnce() -> State<T>,
) -> Result<(), IntegrationError<T>> {
    let limit = options.step_limit;
    if report.accepted + report.rejected >= limit {
        return Err(IntegrationError::StepLimit {
            limit,
            last: state(),
            report: Report {
                stop: StopReason::StepLimit,
                ..*report
            },
        });
    }
    // Below this, time plus step is mostly rounding.
    let lost = T::from_f64(10.0) * T::EPSILON * time.abs();
    // The end may be as near as it likes.
    if !last && (step < options.min_step || step <= lost) {
        return Err(IntegrationError::StepTooSmall {
            step,
            shortest: options.min_step.max(lost),
            last: state(),
            report: Report {
                stop: StopReason::StepTooSmall,
                ..*report
            },
        });
    }
    Ok(())
}
