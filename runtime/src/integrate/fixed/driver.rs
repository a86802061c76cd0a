//! The step loop of all methods with steps of a given length.

use core::ops::ControlFlow;

use crate::integrate::dense::{DenseStep, Interpolant};
use crate::integrate::error::{InputError, IntegrationError};
use crate::integrate::evaluator::{Evaluator, NonFinite};
use crate::integrate::report::{Report, Solution, StopReason};
use crate::integrate::request::{check_start, check_times};
use crate::scalar::Real;
use crate::system::{Ode, State};

/// A step that could not be made.
pub(super) enum Failure<T> {
    /// Rates or state were not finite.
    NonFinite(NonFinite<T>),
    /// The equations of the step were not solved.
    NotSolved { iterations: u32, change: T },
    /// The end of the step was not projected onto the level of the integral.
    NotProjected { iterations: u32, deviation: T },
}

impl<T> From<NonFinite<T>> for Failure<T> {
    fn from(place: NonFinite<T>) -> Self {
        Self::NonFinite(place)
    }
}

/// A method with fixed steps at work: its memory, and how it makes a step.
pub(super) trait FixedStepper<T: Real, O: ?Sized>: Interpolant<T> {
    /// Evaluates what the first step needs; `time` is that of the start.
    fn begin(&mut self, system: &mut Evaluator<'_, T, O>, time: T) -> Result<(), Failure<T>>;

    /// Makes a step of length `step` (negative: backwards) from `time`.
    fn make(
        &mut self,
        system: &mut Evaluator<'_, T, O>,
        time: T,
        step: T,
    ) -> Result<(), Failure<T>>;

    /// Makes the end of the step the start of the next.
    fn advance(&mut self);
}

/// Grid and limits of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid<T> {
    /// Length of the steps.
    pub(super) step: T,
    /// Number of times that a step that is not solved may be halved.
    pub(super) halvings: u32,
    /// Number of steps, made and failed together, after which a run ends.
    pub(super) step_limit: u64,
}

impl<T: Real> Grid<T> {
    /// Runs the method whose memory `new` makes.
    pub(super) fn run<O: Ode<T> + ?Sized, S: FixedStepper<T, O>>(
        &self,
        ode: &O,
        start: &State<T>,
        end: T,
        new: impl FnOnce() -> S,
        mut observer: impl FnMut(&mut DenseStep<'_, T>) -> ControlFlow<()>,
    ) -> Result<Solution<T>, IntegrationError<T>> {
        check_start(ode, start)?;
        check_times(start.time, &[end])?;
        if !(self.step.is_finite() && self.step > T::ZERO) {
            return Err(InputError::Step {
                name: "fixed",
                value: self.step,
            }
            .into());
        }
        let mut report = Report::new();
        if end == start.time {
            return Ok(Solution {
                state: start.clone(),
                report,
            });
        }
        let direction = if end > start.time { T::ONE } else { -T::ONE };
        let lost = T::from_f64(10.0) * T::EPSILON * start.time.abs().max(end.abs());
        let mut time = start.time;
        let mut stepper = new();
        let mut system = Evaluator::new(ode, start.values.len());
        report.next_step = self.step;
        if self.step <= lost {
            return Err(IntegrationError::StepTooSmall {
                step: self.step,
                shortest: lost,
                last: start.clone(),
                report: ended(report, StopReason::StepTooSmall),
            });
        }
        let begun = stepper.begin(&mut system, time);
        report.evaluations = system.evaluations;
        if let Err(failure) = begun {
            return Err(self.failed(failure, start.clone(), report, self.step));
        }
        // The end of step k of the grid is start + k step: rounding does not
        // add up over the steps.
        let (mut number, mut halved, mut length) = (0.0, 0_u32, self.step);
        // Length that is left to the next place of the grid. Steps get this length, not
        // the difference of two rounded times: lengths that tremble would cost
        // the symplectic property, in `f32` visibly.
        let mut left = self.step;
        loop {
            let grid = start.time + direction * T::from_f64(number + 1.0) * self.step;
            // No sliver is left over where rounding misses the end.
            let near = (T::from_f64(1e-9) * self.step).max(lost);
            let goal = if (end - grid) * direction <= near {
                end
            } else {
                grid
            };
            let short = (goal - grid).abs() > near;
            let reach = if short { (goal - time).abs() } else { left };
            let reaches = halved == 0 || reach - length <= near;
            let made = if reaches { reach } else { length };
            let end_time = if reaches {
                goal
            } else {
                time + direction * length
            };

            let state = |stepper: &S| State {
                time,
                values: stepper.start().to_vec(),
            };
            if report.accepted + report.rejected >= self.step_limit {
                return Err(IntegrationError::StepLimit {
                    limit: self.step_limit,
                    last: state(&stepper),
                    report: ended(report, StopReason::StepLimit),
                });
            }
            let outcome = stepper.make(&mut system, time, direction * made);
            report.evaluations = system.evaluations;
            match outcome {
                Ok(()) => {}
                // Rates that are not finite may be those of an iterate far off.
                Err(_) if halved < self.halvings && T::from_f64(0.5) * length > lost => {
                    report.rejected += 1;
                    halved += 1;
                    length = T::from_f64(0.5) * length;
                    continue;
                }
                Err(failure) => {
                    let last = state(&stepper);
                    return Err(self.failed(failure, last, report, made));
                }
            }
            report.accept(made);
            let flow = observer(&mut DenseStep::new(
                &mut stepper,
                &mut report,
                time,
                end_time,
            ));
            stepper.advance();
            time = end_time;
            if reaches {
                number += 1.0;
                left = self.step;
            } else {
                left = left - made;
            }
            if halved > 0 {
                halved -= 1;
                length = length + length;
            }
            let stop = if flow.is_break() {
                StopReason::StoppedByObserver
            } else if time == end {
                StopReason::EndReached
            } else {
                continue;
            };
            return Ok(Solution {
                state: State {
                    time,
                    values: stepper.start().to_vec(),
                },
                report: ended(report, stop),
            });
        }
    }

    fn failed(
        &self,
        failure: Failure<T>,
        last: State<T>,
        report: Report<T>,
        step: T,
    ) -> IntegrationError<T> {
        match failure {
            Failure::NonFinite(place) => place.error(last, report),
            Failure::NotSolved { iterations, change } => IntegrationError::NotSolved {
                step,
                iterations,
                change,
                last,
                report: ended(report, StopReason::NotSolved),
            },
            Failure::NotProjected {
                iterations,
                deviation,
            } => IntegrationError::NotProjected {
                step,
                iterations,
                deviation,
                last,
                report: ended(report, StopReason::NotProjected),
            },
        }
    }
}

fn ended<T: Copy>(report: Report<T>, stop: StopReason) -> Report<T> {
    Report { stop, ..report }
}
