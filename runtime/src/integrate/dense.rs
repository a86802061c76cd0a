//! Dense output: the solution at any time within an accepted step.

use alloc::vec::Vec;
use core::fmt;

use super::error::FirstNumbers;
use super::evaluator::NonFinite;
use super::piece::Piece;
use super::report::Report;
use crate::scalar::Real;

/// A step that a method has completed, with its interpolating polynomial.
pub(crate) trait Made<T> {
    /// Returns the times at the start and at the end of the step.
    fn times(&self) -> [T; 2];

    /// Returns the step with its interpolating polynomial.
    fn piece(&self) -> Piece<'_, T>;

    /// Computes the coefficients of the polynomial, once per step.
    fn prepare(&mut self) -> Result<(), NonFinite<T>>;

    /// Returns the report of the run so far.
    fn report(&self) -> &Report<T>;
}

/// An accepted step: its two ends, and the solution between them.
///
/// Within the step the solution is a polynomial, whose order depends on the method; it is
/// continuous from step to step. Additional evaluations for its coefficients are made only when the
/// first value is requested.
pub struct DenseStep<'a, T> {
    made: &'a mut dyn Made<T>,
}

impl<'a, T: Real> DenseStep<'a, T> {
    pub(crate) fn new(made: &'a mut dyn Made<T>) -> Self {
        Self { made }
    }

    /// Returns the step with its polynomial.
    pub(super) fn piece(&self) -> Piece<'_, T> {
        self.made.piece()
    }

    /// Returns the time at which the step starts.
    pub fn start_time(&self) -> T {
        self.made.times()[0]
    }

    /// Returns the time at which the step ends; smaller than the start time in a run backwards.
    pub fn end_time(&self) -> T {
        self.made.times()[1]
    }

    /// Returns the state at the start of the step.
    pub fn start(&self) -> &[T] {
        self.made.piece().start
    }

    /// Returns the state at the end of the step.
    pub fn end(&self) -> &[T] {
        self.made.piece().end
    }

    /// Returns the report of the run up to the end of this step.
    pub fn report(&self) -> &Report<T> {
        self.made.report()
    }

    /// Returns true if `time` lies within the step, including its ends.
    pub fn contains(&self, time: T) -> bool {
        let [start, end] = self.made.times();
        (start <= time && time <= end) || (end <= time && time <= start)
    }

    /// Writes the solution at `time` to `out`. At the ends of the step this is the state there, bit
    /// for bit.
    ///
    /// # Errors
    ///
    /// [`DenseError`] if `time` is outside the step (or NaN), if the length of `out` differs from
    /// that of the state, or if the right-hand side is not finite at one of the additional
    /// evaluations that the method needs.
    pub fn eval(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        let ends = self.made.times();
        let piece = self.made.piece();
        let fraction = piece.fraction(ends, time, out)?;
        if time == ends[1] {
            out.copy_from_slice(piece.end);
        } else if time == ends[0] {
            out.copy_from_slice(piece.start);
        } else {
            self.made.prepare()?;
            self.made.piece().value(fraction, out);
        }
        Ok(())
    }

    /// Writes the derivative of the dense output at `time` to `out`. Its order is one less than
    /// that of the values.
    ///
    /// # Errors
    ///
    /// As [`eval`](Self::eval).
    pub fn derivative(&mut self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        let ends = self.made.times();
        self.made.piece().fraction(ends, time, out)?;
        self.made.prepare()?;
        self.made.piece().derivative_at(ends, time, out)
    }

    /// Returns the polynomial of the step, after computing its coefficients if necessary.
    pub(crate) fn polynomial(&mut self) -> Result<Piece<'_, T>, DenseError<T>> {
        self.made.prepare()?;
        Ok(self.made.piece())
    }
}

impl<T: Real> Piece<'_, T> {
    /// Writes the solution at `time`, for a step that lasts from `ends[0]` to `ends[1]`.
    pub(crate) fn at(&self, ends: [T; 2], time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        let fraction = self.fraction(ends, time, out)?;
        if time == ends[1] {
            out.copy_from_slice(self.end);
        } else if time == ends[0] {
            out.copy_from_slice(self.start);
        } else {
            self.value(fraction, out);
        }
        Ok(())
    }

    /// Writes the derivative of the solution at `time`, for a step that lasts from `ends[0]` to
    /// `ends[1]`.
    pub(crate) fn derivative_at(
        &self,
        ends: [T; 2],
        time: T,
        out: &mut [T],
    ) -> Result<(), DenseError<T>> {
        let fraction = self.fraction(ends, time, out)?;
        self.slope(fraction, out);
        for rate in out {
            *rate = *rate / (ends[1] - ends[0]);
        }
        Ok(())
    }

    /// Returns the position of `time` within the step from `start` to `end`, as a fraction from 0
    /// to 1. Fails if `time` is outside the step or `out` has the wrong length.
    fn fraction(&self, [start, end]: [T; 2], time: T, out: &[T]) -> Result<T, DenseError<T>> {
        if out.len() != self.start.len() {
            return Err(DenseError::Length {
                expected: self.start.len(),
                found: out.len(),
            });
        }
        let inside = (start <= time && time <= end) || (end <= time && time <= start);
        if !inside {
            return Err(DenseError::OutsideStep { time, start, end });
        }
        Ok((time - start) / (end - start))
    }
}

impl<T: Real> fmt::Debug for DenseStep<'_, T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("DenseStep")
            .field("start_time", &self.start_time())
            .field("end_time", &self.end_time())
            .field("start", &self.start())
            .field("end", &self.end())
            .field("report", self.report())
            .finish_non_exhaustive()
    }
}

impl<T> From<NonFinite<T>> for DenseError<T> {
    fn from(NonFinite { time, values }: NonFinite<T>) -> Self {
        Self::NonFinite { time, values }
    }
}

/// Reason why a step has no dense output at a time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DenseError<T> {
    /// The time is outside the step, where the polynomial is not valid.
    OutsideStep {
        /// Requested time.
        time: T,
        /// Start of the step.
        start: T,
        /// End of the step.
        end: T,
    },
    /// The length of the output slice differs from that of the state.
    Length {
        /// Length of the state.
        expected: usize,
        /// Length of the output slice.
        found: usize,
    },
    /// The right-hand side is infinite or NaN at an additional evaluation of the dense output.
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
                let values = FirstNumbers(values);
                write!(f, "rates are not finite at t = {time}, y = {values}")
            }
        }
    }
}

impl<T: Real> core::error::Error for DenseError<T> {}
