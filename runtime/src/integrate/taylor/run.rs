//! A run under way: what it works on, its account, and its ends.

use super::memory::Memory;
use crate::integrate::error::IntegrationError;
use crate::integrate::options::Options;
use crate::integrate::report::{Report, Solution, StopReason};
use crate::integrate::request::all_finite;
use crate::scalar::Real;
use crate::system::{State, TaylorOde};

/// A run under way.
pub(super) struct Run<'a, T, O: ?Sized> {
    ode: &'a O,
    options: &'a Options<T>,
    order: usize,
    pub(super) memory: Memory<T>,
    pub(super) time: T,
    pub(super) report: Report<T>,
}

impl<'a, T: Real, O: TaylorOde<T> + ?Sized> Run<'a, T, O> {
    /// A run of `ode` about to leave `start`.
    pub(super) fn new(ode: &'a O, options: &'a Options<T>, order: usize, start: &State<T>) -> Self {
        Self {
            ode,
            options,
            order,
            memory: Memory::new(options, order, ode.workspace(order), &start.values),
            time: start.time,
            report: Report::new(),
        }
    }

    /// The Taylor coefficients at the start of the step.
    pub(super) fn expand(&mut self) -> Result<(), IntegrationError<T>> {
        self.report.evaluations += self.order as u64;
        let memory = &mut self.memory;
        self.ode.taylor(
            self.time,
            &memory.start,
            &mut memory.coefficients,
            &mut memory.work,
        );
        // What is not finite further down shows in the end of the step.
        if memory.has_finite_end() {
            Ok(())
        } else {
            Err(self.non_finite(self.time))
        }
    }

    /// Whether a step of length `step` may be made; `last` if it reaches the
    /// end.
    pub(super) fn check_step(&self, step: T, last: bool) -> Result<(), IntegrationError<T>> {
        let limit = self.options.step_limit;
        if self.report.accepted >= limit {
            return Err(IntegrationError::StepLimit {
                limit,
                last: self.state(),
                report: self.ended(StopReason::StepLimit),
            });
        }
        // Below this, time plus step is mostly rounding.
        let lost = T::from_f64(10.0) * T::EPSILON * self.time.abs();
        // The end may be as near as it likes.
        if !last && (step < self.options.min_step || step <= lost) {
            return Err(IntegrationError::StepTooSmall {
                step,
                shortest: self.options.min_step.max(lost),
                last: self.state(),
                report: self.ended(StopReason::StepTooSmall),
            });
        }
        Ok(())
    }

    /// Makes a step of length `step`, with its sign, to `end_time`.
    pub(super) fn make(&mut self, step: T, end_time: T) -> Result<(), IntegrationError<T>> {
        self.memory.make(step, self.options.compensated);
        if !all_finite(&self.memory.end) {
            let at_start = !all_finite(&self.memory.coefficients);
            return Err(self.non_finite(if at_start { self.time } else { end_time }));
        }
        self.report.accept(step.abs());
        Ok(())
    }

    /// The last accepted state.
    fn state(&self) -> State<T> {
        State {
            time: self.time,
            values: self.memory.start.clone(),
        }
    }

    /// The error for a state, or coefficients at the start of the step, that
    /// are not finite.
    fn non_finite(&self, time: T) -> IntegrationError<T> {
        let values = if time == self.time {
            &self.memory.start
        } else {
            &self.memory.end
        };
        IntegrationError::NonFinite {
            time,
            values: values.clone(),
            last: self.state(),
            report: self.ended(StopReason::NonFinite),
        }
    }

    fn ended(&self, stop: StopReason) -> Report<T> {
        Report {
            stop,
            ..self.report
        }
    }

    /// The end of a run that went well.
    pub(super) fn solution(self, stop: StopReason) -> Solution<T> {
        let report = self.ended(stop);
        Solution {
            state: State {
                time: self.time,
                values: self.memory.start,
            },
            report,
        }
    }
}
