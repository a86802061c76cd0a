//! The step loop of all explicit pairs.

use core::marker::PhantomData;
use core::ops::ControlFlow;

use super::ExplicitRungeKutta;
use super::arithmetic::Span;
use super::memory::Memory;
use super::pair::Pair;
use super::run::Run;
use crate::integrate::control::{FirstStep, StepControl};
use crate::integrate::dense::{DenseError, DenseStep, Interpolant};
use crate::integrate::error::IntegrationError;
use crate::integrate::integrator::Integrator;
use crate::integrate::report::{Report, Solution, StopReason};
use crate::integrate::request::{all_finite, check_start, check_times};
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
        let mut run = Run::new::<M>(ode, &self.options, start);
        let direction = if end > start.time { T::ONE } else { -T::ONE };
        let mut control = StepControl::new(M::CONTROL, self.options.beta);
        let mut step = self.first_step(&mut run, end, direction)?;
        loop {
            // A step one per cent longer than planned is better than a sliver
            // at the end.
            let last = step * T::from_f64(1.01) >= (end - run.time).abs();
            run.check_step(&self.options, step, last)?;
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
            run.report.evaluations += M::STAGES as u64 - 1;
            M::stages(&mut run.memory, ode, span).map_err(|rates| run.non_finite(rates))?;
            M::finish(&mut run.memory, span, self.options.compensated);
            let finite = all_finite(&run.memory.end);
            if M::ERROR_USES_END && finite {
                run.evaluate_end::<M>(end_time)?;
            }
            // An end that is not finite may be the fault of the step: try less.
            let error = if finite {
                M::error(&run.memory, span)
            } else {
                T::NAN
            };
            // An error that is NaN must not pass either.
            if !matches!(error.partial_cmp(&T::ONE), Some(order) if order.is_le()) {
                run.report.rejected += 1;
                step = length * control.reject(error);
                run.report.next_step = step;
                continue;
            }
            if !M::ERROR_USES_END {
                run.evaluate_end::<M>(end_time)?;
            }

            run.report.accept(length);
            let proposed = length * control.accept(error);
            // A step cut short by the end says nothing against the planned one.
            step = self.limit(if last { proposed.max(step) } else { proposed });
            run.report.next_step = step;
            let mut made = Made::<M, T, O> {
                ode,
                memory: &mut run.memory,
                span,
                pair: PhantomData,
            };
            let flow = observer(&mut DenseStep::new(
                &mut made,
                &mut run.report,
                span.time,
                end_time,
            ));
            run.memory.advance(M::STAGES + 1);
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

/// A step that was made, with its stages in memory.
struct Made<'a, M, T, O: ?Sized> {
    ode: &'a O,
    memory: &'a mut Memory<T>,
    span: Span<T>,
    pair: PhantomData<M>,
}

impl<M: Pair, T: Real, O: Ode<T> + ?Sized> Interpolant<T> for Made<'_, M, T, O> {
    fn start(&self) -> &[T] {
        &self.memory.start
    }

    fn end(&self) -> &[T] {
        &self.memory.end
    }

    fn prepare(&mut self) -> Result<u64, DenseError<T>> {
        match M::prepare_dense(self.memory, self.ode, self.span) {
            Ok(()) => Ok((M::STAGES_DENSE - M::STAGES - 1) as u64),
            Err(rates) => Err(DenseError::NonFinite {
                time: rates.time,
                values: self.memory.stage.clone(),
            }),
        }
    }

    fn value(&self, fraction: T, out: &mut [T]) {
        M::dense_output(self.memory, fraction, out);
    }
}

impl<M: Pair, T: Real> ExplicitRungeKutta<M, T> {
    fn limit(&self, step: T) -> T {
        self.options
            .max_step
            .map_or(step, |longest| step.min(longest))
    }

    /// Evaluates the rates at the start and chooses the length of the first
    /// step.
    fn first_step<O: Ode<T> + ?Sized>(
        &self,
        run: &mut Run<'_, T, O>,
        end: T,
        direction: T,
    ) -> Result<T, IntegrationError<T>> {
        run.report.evaluations += 1;
        run.memory
            .evaluate_start(run.ode, run.time)
            .map_err(|rates| run.non_finite(rates))?;
        let longest = self.limit((end - run.time).abs());
        if let Some(step) = self.options.initial_step {
            return Ok(self.limit(step));
        }
        let first = FirstStep {
            state: run.memory.scaled_norm(|memory, i| memory.start[i]),
            rates: run.memory.scaled_norm(|memory, i| memory.rates[0][i]),
            longest,
        };
        let euler = first.euler();
        let span = Span {
            time: run.time,
            step: direction * euler,
        };
        run.report.evaluations += 1;
        let change = run
            .memory
            .euler_change(run.ode, span)
            .map_err(|rates| run.non_finite(rates))?;
        Ok(first.refined(euler, change, M::ORDER))
    }
}
