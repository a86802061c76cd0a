//! Integration of a single trajectory by an explicit pair.

use core::convert::identity;
use core::marker::PhantomData;

use super::ExplicitRungeKutta;
use super::pair::EmbeddedPair;
use super::smallest_tolerance;
use super::stages::{ErrorScale, StepStages};
use crate::integrate::checkpoint::Memory;
use crate::integrate::control::{FirstStep, StepControl, Verdict};
use crate::integrate::error::InputError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::options::Options;
use crate::integrate::piece::Piece;
use crate::integrate::request::all_finite;
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::steps::{Failure, Goal, StepLimits, Steps};
use crate::scalar::Real;
use crate::system::{Ode, State};

impl<M: EmbeddedPair, T: Real, O: Ode<T> + ?Sized> Integrator<T, O> for ExplicitRungeKutta<M, T> {
    type Steps = PairSteps<M, T>;

    fn steps(&self, _ode: &O, start: &State<T>) -> Result<PairSteps<M, T>, InputError<T>> {
        self.options.validate(start.values.len())?;
        self.options
            .check_digits(&start.values, smallest_tolerance())?;
        Ok(PairSteps::new(&self.options, start))
    }
}

/// Data of an explicit pair during a run of one trajectory.
#[derive(Clone, Debug)]
#[allow(unreachable_pub)]
pub struct PairSteps<M, T> {
    limits: StepLimits<T>,
    control: StepControl<T>,
    pub(super) stages: StepStages<T>,
    /// Length of the step to try next; `None` before the first one.
    next: Option<T>,
    /// Time and length of the last step.
    span: StepSpan<T>,
    pair: PhantomData<M>,
}

impl<M: EmbeddedPair, T: Real> PairSteps<M, T> {
    /// Prepares the pair for a run from `start`.
    pub(super) fn new(options: &Options<T>, start: &State<T>) -> Self {
        Self {
            limits: StepLimits::new(options),
            control: StepControl::new(M::CONTROL, options),
            stages: StepStages::new::<M, T>(options, start.values.clone(), identity),
            next: None,
            span: StepSpan {
                time: start.time,
                step: T::ZERO,
            },
            pair: PhantomData,
        }
    }

    /// Evaluates the rates at the start and chooses the length of the first step.
    fn first_step<O: Ode<T> + ?Sized>(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, NonFinite<T>> {
        let stages = &mut self.stages;
        stages.evaluate_start(system, time)?;
        let longest = self.limits.limit(goal.distance(time));
        if let Some(step) = self.limits.initial {
            return Ok(self.limits.limit(step));
        }
        let first = FirstStep {
            state: stages.norm(system, &stages.start),
            rates: stages.norm(system, stages.start_rates()),
            longest,
        };
        let euler = first.euler();
        let span = StepSpan {
            time,
            step: goal.direction * euler,
        };
        let change = stages.euler_change(system, span)?;
        Ok(first.refined(euler, change, M::CONTROL.order))
    }
}

impl<M: EmbeddedPair, T: Real, O: Ode<T> + ?Sized> Steps<T, O> for PairSteps<M, T> {
    fn step(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        goal: Goal<T>,
    ) -> Result<T, Failure<T>> {
        let mut step = match self.next {
            Some(step) => step,
            None => self.first_step(system, time, goal)?,
        };
        loop {
            self.next = Some(step);
            let (end_time, last) = goal.plan(time, step);
            self.limits
                .check(system.report, goal.steps_before, (time, step, last))?;
            // The length is the difference of the rounded times, so that lengths add up to times.
            let span = StepSpan {
                time,
                step: end_time - time,
            };
            let length = span.step.abs();

            system.report.next_step = step;
            self.stages.make::<M, _>(system, span)?;
            let finite = all_finite(&self.stages.end);
            if M::ERROR_USES_END && finite {
                self.stages.evaluate_end::<M, _>(system, end_time)?;
            }
            // If the end is not finite, the step may be too long: try a shorter one.
            let error = if finite {
                M::error(&self.stages, system, length)
            } else {
                T::NAN
            };
            match self.control.judge(error, length, (step, last)) {
                Verdict::Accepted(next) => step = next,
                Verdict::Rejected(next) => {
                    system.report.rejected += 1;
                    system.report.next_step = next;
                    step = next;
                    continue;
                }
            }
            if !M::ERROR_USES_END {
                self.stages.evaluate_end::<M, _>(system, end_time)?;
            }
            system.report.accept(length);
            system.report.next_step = step;
            self.next = Some(step);
            self.span = span;
            return Ok(end_time);
        }
    }

    fn prepare(&mut self, system: &mut Evaluator<'_, T, O>, _time: T) -> Result<(), NonFinite<T>> {
        self.stages.prepare_dense::<M, _>(system, self.span)
    }

    fn piece(&self) -> Piece<'_, T> {
        Piece {
            form: M::DENSE.form(),
            start: &self.stages.start,
            end: &self.stages.end,
            terms: [&self.stages.dense, &[]],
            length: self.span.step,
        }
    }

    fn advance(&mut self) {
        let n = self.stages.start.len();
        self.stages.advance::<M, Evaluator<'_, T, O>>(n, ());
    }

    fn restart(&mut self, values: &[T]) {
        self.stages.restart(values);
        self.control.forget();
        self.next = None;
    }

    fn remember(&mut self, memory: &mut Memory<T>) {
        memory.optional(&mut self.next);
        self.control.remember(memory);
        let n = self.stages.start.len();
        memory.numbers(&mut self.stages.rates[..n]);
        memory.numbers(&mut self.stages.start_residue);
    }
}

impl<T: Real, O: Ode<T> + ?Sized> ErrorScale<T> for Evaluator<'_, T, O> {
    type Accepted = ();

    #[inline(always)]
    fn larger_size(one: T, other: T) -> T {
        one.abs().max(other.abs())
    }

    #[inline(always)]
    fn scaled<const N: usize>(&self, mut values: [T; N], tolerance: T) -> [T; N] {
        for value in &mut values {
            if *value != T::ZERO {
                *value = *value / tolerance;
            }
        }
        values
    }

    #[inline(always)]
    fn accept(new: T, _old: T, _accepted: ()) -> T {
        new
    }
}
