//! An accepted step as an observer sees it.

use alloc::vec::Vec;
use core::fmt;

use super::arithmetic::Span;
use super::memory::Memory;
use crate::integrate::report::Report;
use crate::scalar::Real;
use crate::system::Ode;

/// An accepted step: its two ends, and the solution between them.
///
/// Between its ends the solution is a polynomial of order 7: its error falls
/// with the eighth power of the length of the step. It is continuous with its
/// derivative from step to step.
/// Its coefficients cost three evaluations of the right-hand side, which are
/// made when the first value is asked for and never before.
pub struct DenseStep<'a, T> {
    ode: &'a dyn Ode<T>,
    memory: &'a mut Memory<T>,
    report: &'a mut Report<T>,
    span: Span<T>,
    end_time: T,
    prepared: bool,
}

impl<'a, T: Real> DenseStep<'a, T> {
    /// The step `span`, which ends at `end_time`, with stages 1 to 13 in
    /// `memory`.
    pub(super) fn new(
        ode: &'a dyn Ode<T>,
        memory: &'a mut Memory<T>,
        report: &'a mut Report<T>,
        span: Span<T>,
        end_time: T,
    ) -> Self {
        Self {
            ode,
            memory,
            report,
            span,
            end_time,
            prepared: false,
        }
    }

    /// Time at which the step starts.
    pub fn start_time(&self) -> T {
        self.span.time
    }

    /// Time at which the step ends; before the start when running backwards.
    pub fn end_time(&self) -> T {
        self.end_time
    }

    /// State at the start of the step.
    pub fn start(&self) -> &[T] {
        &self.memory.start
    }

    /// State at the end of the step.
    pub fn end(&self) -> &[T] {
        &self.memory.end
    }

    /// Rates at the start of the step.
    pub fn start_rates(&self) -> &[T] {
        &self.memory.rates[0]
    }

    /// Rates at the end of the step.
    pub fn end_rates(&self) -> &[T] {
        &self.memory.rates[12]
    }

    /// The run's account up to and with this step.
    pub fn report(&self) -> &Report<T> {
        self.report
    }

    /// Whether `time` lies within the step, its ends included.
    pub fn contains(&self, time: T) -> bool {
        let (start, end) = (self.span.time, self.end_time);
        (start <= time && time <= end) || (end <= time && time <= start)
    }

    /// Writes the solution at `time` to `out`. At the ends of the step it is
    /// the state there, bit for bit.
    ///
    /// # Errors
    ///
    /// [`DenseError`] if `time` is outside the step (NaN included), if `out`
    /// has not the length of the state, or if the right-hand side is not finite
    /// at one of the three additional points.
    pub fn eval(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        if out.len() != self.memory.start.len() {
            return Err(DenseError::Length {
                expected: self.memory.start.len(),
                found: out.len(),
            });
        }
        if !self.contains(time) {
            return Err(DenseError::OutsideStep {
                time,
                start: self.span.time,
                end: self.end_time,
            });
        }
        if time == self.end_time {
            out.copy_from_slice(&self.memory.end);
            return Ok(());
        }
        if time == self.span.time {
            out.copy_from_slice(&self.memory.start);
            return Ok(());
        }
        if !self.prepared {
            self.report.evaluations += 3;
            self.memory
                .prepare_dense(self.ode, self.span)
                .map_err(|rates| DenseError::NonFinite {
                    time: rates.time,
                    values: self.memory.stage.clone(),
                })?;
            self.prepared = true;
        }
        self.memory
            .dense_output((time - self.span.time) / self.span.step, out);
        Ok(())
    }
}

impl<T: Real> fmt::Debug for DenseStep<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            ode: _,
            memory,
            report,
            span,
            end_time,
            prepared,
        } = self;
        formatter
            .debug_struct("DenseStep")
            .field("start_time", &span.time)
            .field("end_time", end_time)
            .field("start", &memory.start)
            .field("end", &memory.end)
            .field("report", report)
            .field("prepared", prepared)
            .finish_non_exhaustive()
    }
}

/// Why a step has no value to give.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DenseError<T> {
    /// The time is outside the step: the polynomial holds nowhere else.
    OutsideStep {
        /// The time asked for.
        time: T,
        /// Start of the step.
        start: T,
        /// End of the step.
        end: T,
    },
    /// The slice to write to has not the length of the state.
    Length {
        /// Length of the state.
        expected: usize,
        /// Length given.
        found: usize,
    },
    /// The right-hand side is not finite at a point that the dense output
    /// needs.
    NonFinite {
        /// Time of the evaluation.
        time: T,
        /// State of the evaluation.
        values: Vec<T>,
    },
}

impl<T: Real> fmt::Display for DenseError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutsideStep { time, start, end } => {
                write!(f, "time {time} is outside the step from {start} to {end}")
            }
            Self::Length { expected, found } => {
                write!(
                    f,
                    "{found} values asked for from a state of {expected} components"
                )
            }
            Self::NonFinite { time, values } => {
                write!(f, "rates are not finite at t = {time}, y = {values:?}")
            }
        }
    }
}

impl<T: Real> core::error::Error for DenseError<T> {}
