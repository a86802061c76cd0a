//! Values inside an accepted step.

use alloc::vec::Vec;
use core::fmt;

use super::error::FirstNumbers;
use super::evaluator::NonFinite;
use super::piece::Piece;
use super::report::Report;
use crate::scalar::Real;

/// A step that a method has made.
pub(crate) trait Made<T> {
    /// Times at its start and at its end.
    fn times(&self) -> [T; 2];

    /// The step and its polynomial.
    fn piece(&self) -> Piece<'_, T>;

    /// Computes what the polynomial needs, if that has not been done.
    fn prepare(&mut self) -> Result<(), NonFinite<T>>;

    /// The account of the run.
    fn report(&self) -> &Report<T>;
}

/// An accepted step: its two ends, and the solution between them.
///
/// Between its ends the solution is a polynomial whose order the method
/// states; it is continuous from step to step. What its coefficients cost
/// beyond the step itself is spent when the first value is asked for and never
/// before.
pub struct DenseStep<'a, T> {
    made: &'a mut dyn Made<T>,
}

impl<'a, T: Real> DenseStep<'a, T> {
    pub(crate) fn new(made: &'a mut dyn Made<T>) -> Self {
        Self { made }
    }

    /// Time at which the step starts.
    pub fn start_time(&self) -> T {
        self.made.times()[0]
    }

    /// Time at which the step ends; before the start when running backwards.
    pub fn end_time(&self) -> T {
        self.made.times()[1]
    }

    /// State at the start of the step.
    pub fn start(&self) -> &[T] {
        self.made.piece().start
    }

    /// State at the end of the step.
    pub fn end(&self) -> &[T] {
        self.made.piece().end
    }

    /// The run's account up to and with this step.
    pub fn report(&self) -> &Report<T> {
        self.made.report()
    }

    /// Returns true if `time` lies within the step, its ends included.
    pub fn contains(&self, time: T) -> bool {
        let [start, end] = self.made.times();
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

    /// Writes the derivative of the solution at `time` to `out`: of the dense output,
    /// whose order is one less than that of its values.
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

    /// The polynomial of the step.
    pub(crate) fn polynomial(&mut self) -> Result<Piece<'_, T>, DenseError<T>> {
        self.made.prepare()?;
        Ok(self.made.piece())
    }
}

impl<T: Real> Piece<'_, T> {
    /// Writes the solution at `time` in a step between the times `ends`.
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

    /// Writes the derivative of the solution at `time` in a step between the times
    /// `ends`.
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

    /// The fraction of a step between the times `ends` at `time`.
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
                let values = FirstNumbers(values);
                write!(f, "rates are not finite at t = {time}, y = {values}")
            }
        }
    }
}

impl<T: Real> core::error::Error for DenseError<T> {}
