//! The step loop of all explicit pairs.

use core::convert::identity;
use core::marker::PhantomData;
use core::ops::ControlFlow;

use super::ExplicitRungeKutta;
use super::pair::Pair;
use super::stages::{RightHandSide, Span, StepStages};
use crate::integrate::control::{FirstStep, StepControl, Verdict};
use crate::integrate::dense::{DenseError, DenseStep, Interpolant};
use crate::integrate::error::IntegrationError;
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::integrator::Integrator;
use crate::integrate::options::Options;
use crate::integrate::report::{Report, Solution, StopReason};
use crate::integrate::request::{all_finite, check_start, check_step, check_times};
use crate::scalar::Real;
use crate::system::{Ode, State};

impl<M: Pair, T: Real, O: Ode<T> + ?Sized> Integrator<T, O> for ExplicitRungeKutta<M, T> {
    fn integrate(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        mut observer: impl FnMut(&mut DenseStep<'_, T>) -> ControlFlow<()>,
    ) -> Result<Solution<T>, IntegrationError<T>> {
        check_start(ode, start)?;
        check_times(start.time, &[end])?;
        self.options.validate(start.values.len())?;
        if end == start.time {
            return Ok(Solution {
                state: start.clone(),
                report: Report::new(),
            });
        }
        let mut run = Trajectory::<M, T, O>::new(ode, &self.options, start);
        let direction = if end > start.time { T::ONE } else { -T::ONE };
        let mut control = StepControl::new(M::CONTROL, &self.options);
        let mut step = run.first_step(&self.options, end, direction)?;
        loop {
            // A step one per cent longer than planned is better than a sliver
            // at the end.
            let last = step * T::from_f64(1.01) >= (end - run.time).abs();
            check_step(&self.options, &run.report, (run.time, step, last), || {
                run.state()
            })?;
            let end_time = if last {
                end
            } else {
                run.time + direction * step
            };
            // The difference of the rounded times, so that they add up.
            let span = Span {
                time: run.time,
                step: end_time - run.time,
            };
            let length = span.step.abs();

            run.report.next_step = step;
            run.make(span)?;
            let finite = all_finite(&run.stages.end);
            if M::ERROR_USES_END && finite {
                run.evaluate_end(end_time)?;
            }
            // An end that is not finite may be the fault of the step: try less.
            let error = if finite {
                M::error(&run.stages, &run.system, length)
            } else {
                T::NAN
            };
            match control.judge(error, length, (step, last)) {
                Verdict::Accepted(next) => step = next,
                Verdict::Rejected(next) => {
                    run.report.rejected += 1;
                    run.report.next_step = next;
                    step = next;
                    continue;
                }
            }
            if !M::ERROR_USES_END {
                run.evaluate_end(end_time)?;
            }

            run.report.accept(length);
            run.report.next_step = step;
            let mut made = Made::<M, T, O> {
                system: &mut run.system,
                stages: &mut run.stages,
                span,
                pair: PhantomData,
            };
            let flow = observer(&mut DenseStep::new(
                &mut made,
                &mut run.report,
                span.time,
                end_time,
            ));
            run.stages.advance::<M, _>(&run.system, ());
            run.time = end_time;
            if flow.is_break() {
                return Ok(run.solution(StopReason::StoppedByObserver));
            }
            if last {
                return Ok(run.solution(StopReason::EndReached));
            }
        }
    }
}

/// A run under way.
pub(super) struct Trajectory<'a, M, T, O: ?Sized> {
    system: Evaluator<'a, T, O>,
    pub(super) stages: StepStages<T>,
    time: T,
    report: Report<T>,
    pair: PhantomData<M>,
}

impl<'a, M: Pair, T: Real, O: Ode<T> + ?Sized> Trajectory<'a, M, T, O> {
    /// A run of `ode` about to leave `start`.
    pub(super) fn new(ode: &'a O, options: &Options<T>, start: &State<T>) -> Self {
        Self {
            system: Evaluator::new(ode, start.values.len()),
            stages: StepStages::new::<M, T>(options, start.values.clone(), identity),
            time: start.time,
            report: Report::new(),
            pair: PhantomData,
        }
    }

    /// Evaluates the rates at the start and chooses the length of the first
    /// step.
    fn first_step(
        &mut self,
        options: &Options<T>,
        end: T,
        direction: T,
    ) -> Result<T, IntegrationError<T>> {
        self.evaluate_start()?;
        let longest = options.limit((end - self.time).abs());
        if let Some(step) = options.initial_step {
            return Ok(options.limit(step));
        }
        let (system, stages) = (&mut self.system, &mut self.stages);
        let first = FirstStep {
            state: stages.norm(system, &stages.start),
            rates: stages.norm(system, stages.start_rates()),
            longest,
        };
        let euler = first.euler();
        let span = Span {
            time: self.time,
            step: direction * euler,
        };
        let change = stages.euler_change(system, span);
        let change = self.counted(change)?;
        Ok(first.refined(euler, change, M::CONTROL.order))
    }

    /// Evaluates the rates at the start.
    pub(super) fn evaluate_start(&mut self) -> Result<(), IntegrationError<T>> {
        let evaluated = self.stages.evaluate_start(&mut self.system, self.time);
        self.counted(evaluated)
    }

    /// Makes the stages and the end of a step.
    pub(super) fn make(&mut self, span: Span<T>) -> Result<(), IntegrationError<T>> {
        let made = self.stages.make::<M, _>(&mut self.system, span);
        self.counted(made)
    }

    /// Evaluates the rates at the end of the step, at time `time`.
    fn evaluate_end(&mut self, time: T) -> Result<(), IntegrationError<T>> {
        let evaluated = self.stages.evaluate_end::<M, _>(&mut self.system, time);
        self.counted(evaluated)
    }

    /// Takes what became of evaluations, and their number, to the account.
    fn counted<A>(&mut self, outcome: Result<A, NonFinite<T>>) -> Result<A, IntegrationError<T>> {
        self.report.evaluations = self.system.evaluations;
        outcome.map_err(|place| self.non_finite(place))
    }

    /// The last accepted state.
    fn state(&self) -> State<T> {
        State {
            time: self.time,
            values: self.stages.start.clone(),
        }
    }

    /// The error for a state or rates that are not finite at `place`.
    pub(super) fn non_finite(&self, place: NonFinite<T>) -> IntegrationError<T> {
        place.error(self.state(), self.report)
    }

    /// The end of a run that went well.
    fn solution(self, stop: StopReason) -> Solution<T> {
        Solution {
            state: State {
                time: self.time,
                values: self.stages.start,
            },
            report: Report {
                stop,
                ..self.report
            },
        }
    }
}

impl<T: Real, O: Ode<T> + ?Sized> RightHandSide<T> for Evaluator<'_, T, O> {
    type Failure = NonFinite<T>;
    type Accepted = ();

    #[inline(always)]
    fn dimension(&self) -> usize {
        self.dimension()
    }

    #[inline(always)]
    fn evaluate(
        &mut self,
        _stage: usize,
        time: T,
        state: &[T],
        rates: &mut [T],
    ) -> Result<(), NonFinite<T>> {
        self.evaluate(time, state, rates)
    }

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

/// A step that was made, with its stages in memory.
struct Made<'r, 'a, M, T, O: ?Sized> {
    system: &'r mut Evaluator<'a, T, O>,
    stages: &'r mut StepStages<T>,
    span: Span<T>,
    pair: PhantomData<M>,
}

impl<M: Pair, T: Real, O: Ode<T> + ?Sized> Interpolant<T> for Made<'_, '_, M, T, O> {
    fn start(&self) -> &[T] {
        &self.stages.start
    }

    fn end(&self) -> &[T] {
        &self.stages.end
    }

    fn prepare(&mut self) -> Result<u64, DenseError<T>> {
        match self.stages.prepare_dense::<M, _>(self.system, self.span) {
            Ok(()) => Ok((M::NODES.len() - M::STAGES - 1) as u64),
            Err(NonFinite { time, values }) => Err(DenseError::NonFinite { time, values }),
        }
    }

    fn value(&self, fraction: T, out: &mut [T]) {
        self.stages.value::<M>(fraction, out);
    }
}
