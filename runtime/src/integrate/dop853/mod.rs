//! Dormand and Prince's explicit Runge–Kutta method of order 8(5,3).

mod arithmetic;
mod dense;
mod memory;
mod run;
mod tables;

use core::ops::ControlFlow;

use self::arithmetic::{NonFiniteRates, Span};
use self::run::Run;
use super::control::{ControlConstants, FirstStep, StepControl};
use super::error::{InputError, IntegrationError};
use super::options::Options;
use super::report::{Report, Solution, StopReason};
use super::request::{all_finite, check_start, check_times};
use crate::scalar::Real;
use crate::system::{Ode, State};

pub use self::dense::{DenseError, DenseStep};

/// As in the authors' program, but for the safety factor, which is 0.9 there.
/// With 0.8 the paper's pendulum in regular motion takes as many evaluations,
/// has fewer steps rejected and ends with half the error, at tolerances from
/// 1e-7 to 1e-13.
const CONTROL: ControlConstants = ControlConstants {
    order: tables::ORDER,
    safety: 0.8,
    smallest_factor: 1.0 / 3.0,
    largest_factor: 6.0,
    beta_share: 0.2,
};

/// Evaluations of a step beyond its first stage, which the step before made.
const NEW_STAGES: u64 = tables::STAGES as u64 - 1;

/// The explicit Runge–Kutta method of J. R. Dormand and P. J. Prince of order
/// 8, with error estimates of order 5 and 3 and dense output of order 7.
///
/// Twelve evaluations of the right-hand side for an accepted step, eleven for
/// a rejected one, three more where values inside a step are asked for.
/// Memory: 16 + 14 vectors of the state's length, allocated when a run starts;
/// steps allocate nothing.
///
/// Same input, same target, same bits: nothing in a run depends on anything
/// but its arguments. A run that an observer or the step limit has stopped
/// continues with exactly the steps that it would have made, when started
/// again from its last state with [`Report::next_step`] as initial step,
/// provided that [`Options::beta`] is zero and [`Options::compensated`] is
/// off: the memory of the two is not part of a [`State`].
///
/// Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations
/// I*, 2nd edition, Springer 1993, section II.10.
///
/// # Examples
///
/// ```
/// use core::ops::ControlFlow;
/// use branched_pendulum::prelude::*;
///
/// let oscillator = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0];
/// });
/// let start = State::at_rest(0.0, &[1.0]);
/// let method = Dop853::new(Options::with_tolerance(1e-12));
///
/// // Stop at the first step that passes through zero.
/// let solution = method.integrate(&oscillator, &start, 10.0, |step| {
///     if step.end()[0] < 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// })?;
/// assert_eq!(solution.report.stop, StopReason::StoppedByObserver);
/// assert!((solution.state.values[0] - solution.state.time.cos()).abs() < 1e-11);
/// # Ok::<(), IntegrationError<f64>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Dop853<T> {
    options: Options<T>,
}

impl<T: Real> Dop853<T> {
    /// The method with these options, which are checked when a run starts.
    pub fn new(options: Options<T>) -> Self {
        Self { options }
    }

    /// The options of the method.
    pub fn options(&self) -> &Options<T> {
        &self.options
    }

    /// Integrates from `start` to the time `end`, which may lie before it.
    ///
    /// `observer` sees every accepted step and ends the run with
    /// [`ControlFlow::Break`]; the last state is then the end of that step. A
    /// span of zero returns the start at once, without an evaluation.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`]: a request that makes no sense, rates that are not
    /// finite, a step that becomes too small, too many steps. All but the
    /// first carry the last good state.
    pub fn integrate<O: Ode<T> + ?Sized>(
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
        let mut run = Run::new(ode, &self.options, start);
        let direction = if end > start.time { T::ONE } else { -T::ONE };
        let mut control = StepControl::new(CONTROL, self.options.beta);
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
            run.report.evaluations += NEW_STAGES;
            run.memory
                .stages(ode, span)
                .map_err(|rates| run.non_finite(rates))?;
            run.memory.finish(span, self.options.compensated);
            let error = run.memory.error(span);
            // An error that is NaN must not pass either.
            if !matches!(error.partial_cmp(&T::ONE), Some(order) if order.is_le()) {
                run.report.rejected += 1;
                step = length * control.reject(error);
                run.report.next_step = step;
                continue;
            }
            run.report.evaluations += 1;
            run.memory
                .evaluate_end(ode, end_time)
                .map_err(|rates| run.non_finite(rates))?;

            run.report.accept(length);
            let proposed = length * control.accept(error);
            // A step cut short by the end says nothing against the planned one.
            step = self.limit(if last { proposed.max(step) } else { proposed });
            run.report.next_step = step;
            let flow = observer(&mut DenseStep::new(
                &ode,
                &mut run.memory,
                &mut run.report,
                span,
                end_time,
            ));
            run.memory.advance();
            run.time = end_time;
            if flow.is_break() {
                return Ok(run.solution(StopReason::StoppedByObserver));
            }
            if last {
                return Ok(run.solution(StopReason::EndReached));
            }
        }
    }

    /// Integrates from `start` through the given times, in their order, and
    /// calls `visit` with each time and the state there.
    ///
    /// The states come from the dense output: the steps are those of
    /// [`integrate`](Self::integrate) to the last time, however many times lie
    /// between. Times equal to the start are visited with the start itself;
    /// equal times are visited as often as they stand there. Without times the
    /// start is returned.
    ///
    /// # Errors
    ///
    /// As [`integrate`](Self::integrate); times must be finite and run one way
    /// from the start. After an error all times up to the last good state have
    /// been visited, unless the rates were not finite within the last step.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    ///
    /// let decay = OdeFn::new(1, |_time: f64, y: &[f64], rates: &mut [f64]| rates[0] = -y[0]);
    /// let times = [0.0, 0.5, 1.0, 2.0];
    /// let mut samples = Vec::new();
    /// let solution = Dop853::new(Options::with_tolerance(1e-10)).sample(
    ///     &decay,
    ///     &State::new(0.0, vec![1.0]),
    ///     &times,
    ///     |time, y| samples.push((time, y[0])),
    /// )?;
    /// assert_eq!(samples.len(), times.len());
    /// for (time, y) in samples {
    ///     assert!((y - (-time).exp()).abs() < 1e-9);
    /// }
    /// assert_eq!(solution.state.time, 2.0);
    /// # Ok::<(), IntegrationError<f64>>(())
    /// ```
    pub fn sample<O: Ode<T> + ?Sized>(
        &self,
        ode: &O,
        start: &State<T>,
        times: &[T],
        mut visit: impl FnMut(T, &[T]),
    ) -> Result<Solution<T>, IntegrationError<T>> {
        check_start(ode, start)?;
        check_times(start.time, times)?;
        self.options.validate(start.values.len())?;
        let mut pending = times.iter().copied().peekable();
        while pending.next_if(|&time| time == start.time).is_some() {
            visit(start.time, &start.values);
        }
        let end = times.last().copied().unwrap_or(start.time);
        let mut values = start.values.clone();
        let mut failure = None;
        let solution = self.integrate(ode, start, end, |step| {
            while let Some(time) = pending.next_if(|&time| step.contains(time)) {
                match step.eval(time, &mut values) {
                    Ok(()) => visit(time, &values),
                    Err(error) => {
                        failure = Some(error);
                        return ControlFlow::Break(());
                    }
                }
            }
            ControlFlow::Continue(())
        })?;
        match failure {
            // Time and length were right, so the rates were not finite.
            Some(DenseError::NonFinite { time, values }) => Err(IntegrationError::NonFinite {
                time,
                values,
                last: solution.state,
                report: Report {
                    stop: StopReason::NonFinite,
                    ..solution.report
                },
            }),
            _ => Ok(solution),
        }
    }

    /// One step of length `step` (negative: backwards), whatever its error.
    ///
    /// For tests of the method and for loops with a step of their own; it
    /// evaluates the right-hand side twelve times and allocates. Tolerances and
    /// step limits have no say, and sums are plain.
    ///
    /// # Errors
    ///
    /// [`IntegrationError`] if the request makes no sense, or if the state or
    /// its rates are not finite.
    pub fn step<O: Ode<T> + ?Sized>(
        &self,
        ode: &O,
        start: &State<T>,
        step: T,
    ) -> Result<State<T>, IntegrationError<T>> {
        check_start(ode, start)?;
        self.options.validate(start.values.len())?;
        if !step.is_finite() {
            return Err(InputError::FixedStep { value: step }.into());
        }
        let mut run = Run::new(ode, &self.options, start);
        let span = Span {
            time: start.time,
            step,
        };
        let end_time = start.time + step;
        run.report.evaluations = 1 + NEW_STAGES;
        run.memory
            .evaluate_start(ode, start.time)
            .and_then(|()| run.memory.stages(ode, span))
            .map_err(|rates| run.non_finite(rates))?;
        run.memory.finish(span, false);
        if !all_finite(&run.memory.end) {
            run.memory.stage.copy_from_slice(&run.memory.end);
            return Err(run.non_finite(NonFiniteRates { time: end_time }));
        }
        Ok(State {
            time: end_time,
            values: run.memory.end,
        })
    }

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
        Ok(first.refined(euler, change, tables::ORDER))
    }
}
