//! A run in progress, used by all functions that advance a motion.

use alloc::vec::Vec;
use core::borrow::Borrow;
use core::marker::PhantomData;

use super::checkpoint::Memory;
use super::dense::{DenseError, DenseStep, Made};
use super::error::{InputError, IntegrationError, RunError};
use super::evaluator::{Evaluator, NonFinite};
use super::integrator::Integrator;
use super::piece::Piece;
use super::report::{Report, Solution, StopReason};
use super::request::{check_end, check_start, check_times};
use super::steps::{Goal, Steps};
use crate::interruption;
use crate::scalar::Real;
use crate::system::{Ode, State, Workspace};

/// A run in progress: the method's data, the equations, the time that has been reached, and the
/// report.
///
/// `B` owns or borrows the equations `O`.
#[derive(Clone, Debug)]
pub(super) struct Run<B, O: ?Sized, S, T> {
    pub(super) ode: B,
    equations: PhantomData<fn(&O)>,
    steps: S,
    workspace: Workspace<T>,
    report: Report<T>,
    dimension: usize,
    /// Times at the start and at the end of the last step; equal if there is none.
    times: [T; 2],
    /// True if the last step has been made but not yet been passed to the caller.
    made: bool,
    /// True if the dense output of the last step has been computed.
    prepared: bool,
}

impl<B: Borrow<O>, O: Ode<T> + ?Sized, S: Steps<T, O>, T: Real> Run<B, O, S, T> {
    /// Creates a run of `method` from `start` to the time `end`. Both are validated.
    pub(super) fn to_end<M>(
        method: &M,
        ode: B,
        start: &State<T>,
        end: T,
    ) -> Result<Self, IntegrationError<T>>
    where
        M: Integrator<T, O, Steps = S> + ?Sized,
    {
        check_start(ode.borrow(), (start.time, &start.values))?;
        check_end(end)?;
        Self::new(method, ode, start, &[])
    }

    /// Creates a run of `method` from `start`. Validates `start` and the output `times`.
    pub(super) fn new<M>(
        method: &M,
        ode: B,
        start: &State<T>,
        times: &[T],
    ) -> Result<Self, IntegrationError<T>>
    where
        M: Integrator<T, O, Steps = S> + ?Sized,
    {
        check_start(ode.borrow(), (start.time, &start.values))?;
        check_times(start.time, times)?;
        Ok(Self {
            steps: method.steps(ode.borrow(), start)?,
            ode,
            equations: PhantomData,
            workspace: Workspace::new(),
            report: Report::new(),
            dimension: start.values.len(),
            times: [start.time; 2],
            made: false,
            prepared: false,
        })
    }

    /// Returns the time that the run has reached.
    pub(super) fn time(&self) -> T {
        self.times[1]
    }

    /// Returns the state that the run has reached.
    pub(super) fn state(&self) -> &[T] {
        let piece = self.steps.piece();
        if self.made { piece.end } else { piece.start }
    }

    /// Returns the goal of a run that ends at the time `end`.
    pub(super) fn goal(&self, end: T) -> Goal<T> {
        let forwards = end >= self.time();
        self.goal_towards(Some(end), if forwards { T::ONE } else { -T::ONE })
    }

    /// Returns the goal of a run in a direction, with an end time if one is given.
    pub(super) fn goal_towards(&self, end: Option<T>, direction: T) -> Goal<T> {
        Goal {
            end,
            direction,
            steps_before: self.report.accepted + self.report.rejected,
        }
    }

    /// Borrows the data of the method and the evaluator of the equations separately.
    fn parts(&mut self) -> (&mut S, Evaluator<'_, T, O>) {
        let system = Evaluator {
            ode: self.ode.borrow(),
            dimension: self.dimension,
            workspace: &mut self.workspace,
            report: &mut self.report,
        };
        (&mut self.steps, system)
    }

    /// Makes the next step towards the goal.
    ///
    /// # Errors
    /// The error of the method, with the last good state, from which the run can continue.
    #[inline(always)]
    pub(super) fn step(&mut self, goal: Goal<T>) -> Result<(), IntegrationError<T>> {
        if self.made {
            self.steps.advance();
            self.made = false;
        }
        interruption::look();
        let start = self.times[1];
        self.times = [start; 2];
        let (steps, mut system) = self.parts();
        match steps.step(&mut system, start, goal) {
            Ok(end) => {
                self.times = [start, end];
                (self.made, self.prepared) = (true, false);
                Ok(())
            }
            Err(failure) => {
                let last = State::new(start, self.steps.piece().start.to_vec());
                Err(failure.error(last, &self.report))
            }
        }
    }

    /// Makes the next step towards the goal and returns it; returns `None` if the goal has been
    /// reached.
    #[inline(always)]
    pub(super) fn step_to(
        &mut self,
        goal: Goal<T>,
    ) -> Result<Option<DenseStep<'_, T>>, IntegrationError<T>> {
        if goal.end == Some(self.time()) {
            return Ok(None);
        }
        self.step(goal)?;
        Ok(Some(DenseStep::new(self)))
    }

    /// Restarts from these values.
    pub(super) fn restart(&mut self, time: T, values: &[T]) {
        self.steps.restart(values);
        self.times = [time; 2];
        self.made = false;
    }

    /// Saves the numbers on which further steps depend. First makes the end of the last step the
    /// start of the next one.
    pub(super) fn save(&mut self) -> Vec<T> {
        if self.made {
            self.steps.advance();
            self.made = false;
            self.times[0] = self.times[1];
        }
        let mut memory = Memory::new();
        self.steps.remember(&mut memory);
        memory.into_numbers()
    }

    /// Restores the numbers on which further steps depend, and the report of the earlier steps.
    pub(super) fn restore(
        &mut self,
        numbers: &[T],
        report: &Report<T>,
    ) -> Result<(), InputError<T>> {
        let mut memory = Memory::of(numbers);
        self.steps.remember(&mut memory);
        self.report = *report;
        match memory.counts() {
            (found, expected) if found == expected => Ok(()),
            (found, expected) => Err(InputError::Checkpoint { expected, found }),
        }
    }

    /// Returns the last state and the report of the run.
    pub(super) fn solution(&self, stop: StopReason) -> Solution<T> {
        Solution {
            state: State {
                time: self.time(),
                values: self.state().to_vec(),
            },
            report: Report {
                stop,
                ..self.report
            },
        }
    }

    /// Creates the error of a run whose observer failed at this time and state.
    #[cold]
    pub(super) fn stopped_at<E>(&self, time: T, values: &[T], error: E) -> RunError<T, E> {
        RunError::Observer {
            error,
            last: State::new(time, values.to_vec()),
            report: Report {
                stop: StopReason::StoppedByObserver,
                ..self.report
            },
        }
    }

    /// Creates the error of a run whose last step has no dense output. Time and length were valid,
    /// so the rates were not finite.
    #[cold]
    pub(super) fn dense_failure(&self, error: DenseError<T>) -> IntegrationError<T> {
        let Solution { state, report } = self.solution(StopReason::NonFinite);
        let (time, values) = match error {
            DenseError::NonFinite { time, values } => (time, values),
            DenseError::OutsideStep { .. } | DenseError::Length { .. } => {
                (state.time, state.values.clone())
            }
        };
        IntegrationError::NonFinite {
            time,
            values,
            last: state,
            report,
        }
    }
}

impl<B: Borrow<O>, O: Ode<T> + ?Sized, S: Steps<T, O>, T: Real> Made<T> for Run<B, O, S, T> {
    fn times(&self) -> [T; 2] {
        self.times
    }

    fn piece(&self) -> Piece<'_, T> {
        self.steps.piece()
    }

    fn prepare(&mut self) -> Result<(), NonFinite<T>> {
        if !self.prepared {
            let start = self.times[0];
            let (steps, mut system) = self.parts();
            steps.prepare(&mut system, start)?;
            self.prepared = true;
        }
        Ok(())
    }

    fn report(&self) -> &Report<T> {
        &self.report
    }
}
