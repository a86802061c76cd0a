//! Values inside an accepted step.

use alloc::vec::Vec;
use core::fmt;

use super::report::Report;
use crate::scalar::Real;

/// A step that a method has made.
pub(crate) trait Interpolant<T> {
    /// State at the start of the step.
    fn start(&self) -> &[T];

    /// State at the end of the step.
    fn end(&self) -> &[T];

    /// Prepares [`value`](Self::value); called once, before the first of them.
    /// Returns the number of evaluations of the right-hand side: none, unless the
    /// method says otherwise.
    fn prepare(&mut self) -> Result<u64, DenseError<T>> {
        Ok(0)
    }

    /// Writes the solution at the fraction `fraction` of the step, from 0 to 1.
    fn value(&self, fraction: T, out: &mut [T]);
}

/// An accepted step: its two ends, and the solution between them.
///
/// Between its ends the solution is a polynomial whose order the method
/// states; it is continuous from step to step. What its coefficients cost
/// beyond the step itself is spent when the first value is asked for and never
/// before.
pub struct DenseStep<'a, T> {
    interpolant: &'a mut dyn Interpolant<T>,
    report: &'a mut Report<T>,
    start_time: T,
    end_time: T,
    prepared: bool,
}

impl<'a, T: Real> DenseStep<'a, T> {
    pub(crate) fn new(
        interpolant: &'a mut dyn Interpolant<T>,
        report: &'a mut Report<T>,
        start_time: T,
        end_time: T,
    ) -> Self {
        Self {
            interpolant,
            report,
            start_time,
            end_time,
            prepared: false,
        }
    }

    /// Time at which the step starts.
    pub fn start_time(&self) -> T {
        self.start_time
    }

    /// Time at which the step ends; before the start when running backwards.
    pub fn end_time(&self) -> T {
        self.end_time
    }

    /// State at the start of the step.
    pub fn start(&self) -> &[T] {
        self.interpolant.start()
    }

    /// State at the end of the step.
    pub fn end(&self) -> &[T] {
        self.interpolant.end()
    }

    /// The run's account up to and with this step.
    pub fn report(&self) -> &Report<T> {
        self.report
    }

    /// Returns true if `time` lies within the step, its ends included.
    pub fn contains(&self, time: T) -> bool {
        let (start, end) = (self.start_time, self.end_time);
        (start <= time && time <= end) || (end <= time && time <= start)
    }

    /// Writes the solution at `time` to `out`. At the ends of the step it is
    /// the state there, bit for bit.
    ///
    /// # Errors
    ///
    /// [`DenseError`] if `time` is outside the step (NaN included), if `out`
    /// has not the length of the state, or if the right-hand side is not finite
    /// at one of the additional points that the method needs.
    pub fn eval(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        let dimension = self.start().len();
        if out.len() != dimension {
            return Err(DenseError::Length {
                expected: dimension,
                found: out.len(),
            });
        }
        if !self.contains(time) {
            return Err(DenseError::OutsideStep {
                time,
                start: self.start_time,
                end: self.end_time,
            });
        }
        if time == self.end_time {
            out.copy_from_slice(self.end());
            return Ok(());
        }
        if time == self.start_time {
            out.copy_from_slice(self.start());
            return Ok(());
        }
        if !self.prepared {
            self.report.evaluations += self.interpolant.prepare()?;
            self.prepared = true;
        }
        let fraction = (time - self.start_time) / (self.end_time - self.start_time);
        self.interpolant.value(fraction, out);
        Ok(())
    }
}

impl<T: Real> fmt::Debug for DenseStep<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            interpolant,
            report,
            start_time,
            end_time,
            prepared,
        } = self;
        formatter
            .debug_struct("DenseStep")
            .field("start_time", start_time)
            .field("end_time", end_time)
            .field("start", &interpolant.start())
            .field("end", &interpolant.end())
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
