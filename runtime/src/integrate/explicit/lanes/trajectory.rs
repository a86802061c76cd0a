//! The trajectory in one lane: its step-size control, its account, its errors.

use alloc::vec::Vec;

use super::memory::{Memory, Numbers, numbers, numbers_in, sum};
use super::step::{node, row};
use crate::integrate::control::{FirstStep, StepControl};
use crate::integrate::error::IntegrationError;
use crate::integrate::explicit::DormandPrince8;
use crate::integrate::explicit::arithmetic::Span;
use crate::integrate::explicit::dop853::tables::{C, ORDER, STAGES};
use crate::integrate::explicit::pair::Pair;
use crate::integrate::explicit::run::check_step;
use crate::integrate::options::Options;
use crate::integrate::report::{Report, Solution, StopReason};
use crate::scalar::register::Register;
use crate::scalar::{Lane, Real, Scalar};
use crate::system::State;

/// What all trajectories have in common.
pub(super) struct Request<'a, T> {
    pub(super) options: &'a Options<T>,
    pub(super) end: T,
}

/// A trajectory under way.
pub(super) struct Trajectory<T> {
    /// Its place among the starts.
    pub(super) index: usize,
    pub(super) time: T,
    direction: T,
    step: T,
    end_time: T,
    last: bool,
    control: StepControl<T>,
    report: Report<T>,
}

/// What became of a step.
pub(super) enum Verdict<T> {
    /// Its error was too large.
    Rejected,
    /// It was accepted; `last` if it reached the end.
    Accepted { last: bool },
    /// The trajectory ends here.
    Failed(IntegrationError<T>),
}

impl<T: Lane> Trajectory<T> {
    pub(super) fn new(request: &Request<'_, T>, index: usize, time: T) -> Self {
        let forwards = request.end > time;
        Self {
            index,
            time,
            direction: if forwards { T::ONE } else { -T::ONE },
            step: T::ZERO,
            end_time: time,
            last: false,
            control: StepControl::new(DormandPrince8::CONTROL, request.options.beta),
            report: Report::new(),
        }
    }

    /// After the rates at the start: the length of the Euler step from which the
    /// first step is estimated, with its sign. Zero where that is given.
    pub(super) fn euler<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &Memory<R>,
        lane: usize,
    ) -> Result<T, IntegrationError<T>> {
        let n = memory.start.len();
        self.report.evaluations += 1;
        if !numbers(memory.checks[0])[lane].is_finite() {
            let values = numbers_in(&memory.start, lane);
            return Err(self.non_finite(memory, lane, (self.time, values)));
        }
        if let Some(step) = request.options.initial_step {
            self.step = limit(request.options, step);
            return Ok(T::ZERO);
        }
        self.report.evaluations += 1;
        let state = numbers_in(&memory.start, lane);
        let rates = numbers_in(&memory.rates[..n], lane);
        let first = FirstStep {
            state: scaled_norm(memory, lane, &state),
            rates: scaled_norm(memory, lane, &rates),
            longest: limit(request.options, (request.end - self.time).abs()),
        };
        self.step = first.euler();
        Ok(self.direction * self.step)
    }

    /// After the rates at the end of the Euler step: chooses the first step.
    pub(super) fn first_step<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &Memory<R>,
        lane: usize,
    ) -> Result<(), IntegrationError<T>> {
        if request.options.initial_step.is_some() {
            return Ok(());
        }
        let n = memory.start.len();
        if !numbers(memory.checks[1])[lane].is_finite() {
            let time = self.time + self.direction * self.step;
            let values = numbers_in(&memory.stage, lane);
            return Err(self.non_finite(memory, lane, (time, values)));
        }
        let state = numbers_in(&memory.start, lane);
        let rates = numbers_in(&memory.rates[..n], lane);
        let mut change = numbers_in(&memory.rates[n..2 * n], lane);
        for (change, &rate) in change.iter_mut().zip(&rates) {
            *change = *change - rate;
        }
        let first = FirstStep {
            state: scaled_norm(memory, lane, &state),
            rates: scaled_norm(memory, lane, &rates),
            longest: limit(request.options, (request.end - self.time).abs()),
        };
        let change = scaled_norm(memory, lane, &change);
        self.step = first.refined(self.step, change, ORDER);
        Ok(())
    }

    /// Time and step of what is tried next.
    pub(super) fn plan<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &Memory<R>,
        lane: usize,
    ) -> Result<Span<T>, IntegrationError<T>> {
        // As the driver of the plain methods.
        self.last = self.step * T::from_f64(1.01) >= (request.end - self.time).abs();
        let attempt = (self.time, self.step, self.last);
        check_step(request.options, &self.report, attempt, || {
            memory.state(lane, self.time)
        })?;
        self.end_time = if self.last {
            request.end
        } else {
            self.time + self.direction * self.step
        };
        self.report.next_step = self.step;
        self.report.evaluations += STAGES as u64 - 1;
        Ok(self.span())
    }

    fn span(&self) -> Span<T> {
        Span {
            time: self.time,
            step: self.end_time - self.time,
        }
    }

    /// Judges the step that was made, by its scaled error; NaN where its end is
    /// not finite.
    pub(super) fn judge<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &Memory<R>,
        lane: usize,
        (error, finite): (T, &Finite<T>),
    ) -> Verdict<T> {
        if !finite.stages[lane].is_finite() {
            let place = failed_stage(memory, lane, self.span());
            return Verdict::Failed(self.non_finite(memory, lane, place));
        }
        let length = self.span().step.abs();
        let error = if finite.end[lane].is_finite() {
            error
        } else {
            T::NAN
        };
        // An error that is NaN must not pass either.
        if !matches!(error.partial_cmp(&T::ONE), Some(order) if order.is_le()) {
            self.report.rejected += 1;
            self.step = length * self.control.reject(error);
            self.report.next_step = self.step;
            return Verdict::Rejected;
        }
        self.report.evaluations += 1;
        if !finite.end_rates[lane].is_finite() {
            let place = (self.end_time, numbers_in(&memory.end, lane));
            return Verdict::Failed(self.non_finite(memory, lane, place));
        }
        self.report.accept(length);
        let proposed = length * self.control.accept(error);
        // A step cut short by the end says nothing against the planned one.
        let wanted = if self.last {
            proposed.max(self.step)
        } else {
            proposed
        };
        self.step = limit(request.options, wanted);
        self.report.next_step = self.step;
        self.time = self.end_time;
        Verdict::Accepted { last: self.last }
    }

    fn non_finite<R: Register<Lane = T>>(
        &self,
        memory: &Memory<R>,
        lane: usize,
        (time, values): (T, Vec<T>),
    ) -> IntegrationError<T> {
        IntegrationError::NonFinite {
            time,
            values,
            last: memory.state(lane, self.time),
            report: Report {
                stop: StopReason::NonFinite,
                ..self.report
            },
        }
    }

    /// The end of a run that went well.
    pub(super) fn solution(&self, state: State<T>) -> Solution<T> {
        Solution {
            state,
            report: Report {
                stop: StopReason::EndReached,
                ..self.report
            },
        }
    }
}

/// What is finite in a step, lane by lane: zero if so, and NaN if not.
pub(super) struct Finite<T> {
    /// The rates of the stages, without those at the end.
    pub(super) stages: Numbers<T>,
    /// The state at the end.
    pub(super) end: Numbers<T>,
    /// The rates there.
    pub(super) end_rates: Numbers<T>,
}

fn limit<T: Real>(options: &Options<T>, step: T) -> T {
    options.max_step.map_or(step, |longest| step.min(longest))
}

/// Euclidean norm of what is divided by its tolerance at the start of the step.
fn scaled_norm<R: Register>(memory: &Memory<R>, lane: usize, vector: &[R::Lane]) -> R::Lane {
    let mut sum = R::Lane::ZERO;
    for (i, &value) in vector.iter().enumerate() {
        let of = |registers: &[R]| numbers(registers[i])[lane];
        let scale = of(&memory.absolute) + of(&memory.relative) * of(&memory.start).abs();
        let ratio = value / scale;
        sum += ratio * ratio;
    }
    Scalar::sqrt(sum)
}

/// Time and state of the first stage whose rates are not finite in a lane.
fn failed_stage<R: Register>(
    memory: &Memory<R>,
    lane: usize,
    span: Span<R::Lane>,
) -> (R::Lane, Vec<R::Lane>) {
    let n = memory.start.len();
    let failed = |stage: &usize| !numbers(memory.checks[stage - 1])[lane].is_finite();
    let stage = (2..STAGES).find(failed).unwrap_or(STAGES);
    // The same operations as in the step.
    let span = Span {
        time: R::splat(span.time),
        step: R::splat(span.step),
    };
    let values: Vec<R> = (0..n)
        .map(|i| {
            span.step
                .mul_add(sum(row(stage), &memory.rates, n, i), memory.start[i])
        })
        .collect();
    let time = numbers(node(span, C[stage - 1]))[lane];
    (time, numbers_in(&values, lane))
}
