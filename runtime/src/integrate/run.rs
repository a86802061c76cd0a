//! A run under way, whoever asks for its steps.

use super::dense::{DenseError, DenseStep, Made};
use super::error::IntegrationError;
use super::evaluator::{Evaluator, NonFinite};
use super::piece::Piece;
use super::report::{Report, Solution, StopReason};
use super::steps::{Goal, Steps};
use crate::scalar::Real;
use crate::system::{State, Workspace};

/// A method at work, with the time it has reached and its account. The equations are
/// handed over with each request.
#[derive(Clone, Debug)]
pub(super) struct Run<S, T> {
    steps: S,
    workspace: Workspace<T>,
    report: Report<T>,
    dimension: usize,
    /// Times at the start and at the end of the last step; equal where there is none.
    times: [T; 2],
    /// True if the last step is still between its start and its end.
    made: bool,
    /// True if values inside it can be had.
    prepared: bool,
}

impl<S, T: Real> Run<S, T> {
    /// A run of `steps` about to leave `start`.
    pub(super) fn new(steps: S, start: &State<T>) -> Self {
        Self {
            steps,
            workspace: Workspace::new(),
            report: Report::new(),
            dimension: start.values.len(),
            times: [start.time; 2],
            made: false,
            prepared: false,
        }
    }

    /// Time that the run has reached.
    pub(super) fn time(&self) -> T {
        self.times[1]
    }

    /// The account so far.
    pub(super) fn report(&self) -> &Report<T> {
        &self.report
    }

    /// The goal `end`, or the way in that direction without one.
    pub(super) fn goal(&self, end: Option<T>, direction: T) -> Goal<T> {
        Goal {
            end,
            direction,
            steps_before: self.report.accepted + self.report.rejected,
        }
    }

    /// Splits into the steps and what they work with.
    fn parts<'r, O: ?Sized>(&'r mut self, ode: &'r O) -> (&'r mut S, Evaluator<'r, T, O>) {
        let system = Evaluator {
            ode,
            dimension: self.dimension,
            workspace: &mut self.workspace,
            report: &mut self.report,
        };
        (&mut self.steps, system)
    }

    /// Makes the next step towards the goal.
    ///
    /// # Errors
    /// As the method's, with the last good state, from which the run can be asked
    /// to go on.
    #[inline(always)]
    pub(super) fn step<O: ?Sized>(
        &mut self,
        ode: &O,
        goal: Goal<T>,
    ) -> Result<(), IntegrationError<T>>
    where
        S: Steps<T, O>,
    {
        if self.made {
            self.steps.advance();
            self.made = false;
        }
        let start = self.times[1];
        let (steps, mut system) = self.parts(ode);
        match steps.step(&mut system, start, goal) {
            Ok(end) => {
                self.times = [start, end];
                (self.made, self.prepared) = (true, false);
                Ok(())
            }
            Err(failure) => {
                self.times = [start; 2];
                let last = State {
                    time: start,
                    values: self.steps.piece().start.to_vec(),
                };
                Err(failure.error(last, &self.report))
            }
        }
    }

    /// The state that the run has reached.
    pub(super) fn state<O: ?Sized>(&self) -> &[T]
    where
        S: Steps<T, O>,
    {
        let piece = self.steps.piece();
        if self.made { piece.end } else { piece.start }
    }

    /// Starts anew from these values.
    pub(super) fn restart<O: ?Sized>(&mut self, time: T, values: &[T])
    where
        S: Steps<T, O>,
    {
        self.steps.restart(values);
        self.times = [time; 2];
        self.made = false;
    }

    /// Times at the start and at the end of the last step.
    pub(super) fn times(&self) -> [T; 2] {
        self.times
    }

    /// The last step.
    pub(super) fn piece<O: ?Sized>(&self) -> Piece<'_, T>
    where
        S: Steps<T, O>,
    {
        self.steps.piece()
    }

    /// Computes what values inside the last step need, if that has not been done.
    pub(super) fn prepare<O: ?Sized>(&mut self, ode: &O) -> Result<(), NonFinite<T>>
    where
        S: Steps<T, O>,
    {
        if !self.prepared {
            let start = self.times[0];
            let (steps, mut system) = self.parts(ode);
            steps.prepare(&mut system, start)?;
            self.prepared = true;
        }
        Ok(())
    }
}

/// A run and the equations that it borrows.
pub(super) struct RunOn<'o, O: ?Sized, S, T> {
    pub(super) ode: &'o O,
    pub(super) run: Run<S, T>,
}

impl<O: ?Sized, S: Steps<T, O>, T: Real> RunOn<'_, O, S, T> {
    /// The goal `end`.
    pub(super) fn goal(&self, end: T) -> Goal<T> {
        let forwards = end >= self.run.time();
        let direction = if forwards { T::ONE } else { -T::ONE };
        self.run.goal(Some(end), direction)
    }

    /// Makes the next step towards the goal; none where that is reached.
    #[inline(always)]
    pub(super) fn step_to(
        &mut self,
        goal: Goal<T>,
    ) -> Result<Option<DenseStep<'_, T>>, IntegrationError<T>> {
        if goal.end == Some(self.run.time()) {
            return Ok(None);
        }
        self.run.step(self.ode, goal)?;
        Ok(Some(DenseStep::new(self)))
    }

    /// The end of the run.
    pub(super) fn solution(&self, stop: StopReason) -> Solution<T> {
        Solution {
            state: State {
                time: self.run.time(),
                values: self.run.state::<O>().to_vec(),
            },
            report: Report {
                stop,
                ..*self.run.report()
            },
        }
    }

    /// The end of a run whose last step had no value to give.
    #[cold]
    pub(super) fn dense_failure(&self, error: DenseError<T>) -> IntegrationError<T> {
        dense_failure(error, self.solution(StopReason::NonFinite))
    }
}

impl<O: ?Sized, S: Steps<T, O>, T: Real> Made<T> for RunOn<'_, O, S, T> {
    fn times(&self) -> [T; 2] {
        self.run.times()
    }

    fn piece(&self) -> Piece<'_, T> {
        self.run.piece::<O>()
    }

    fn prepare(&mut self) -> Result<(), NonFinite<T>> {
        self.run.prepare(self.ode)
    }

    fn report(&self) -> &Report<T> {
        self.run.report()
    }
}

/// The end of a run that `solution` describes, whose last step had no value to
/// give: time and length were right, so the rates were not finite.
pub(super) fn dense_failure<T: Real>(
    error: DenseError<T>,
    solution: Solution<T>,
) -> IntegrationError<T> {
    let (time, values) = match error {
        DenseError::NonFinite { time, values } => (time, values),
        DenseError::OutsideStep { .. } | DenseError::Length { .. } => {
            (solution.state.time, solution.state.values.clone())
        }
    };
    IntegrationError::NonFinite {
        time,
        values,
        last: solution.state,
        report: solution.report,
    }
}
