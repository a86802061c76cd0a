//! A computed motion that can be evaluated at any time.

#[cfg(feature = "serde")]
mod read;

use alloc::vec;
use alloc::vec::Vec;

use super::dense::{DenseError, DenseStep};
use super::piece::{Form, Piece};
use crate::scalar::Real;
use crate::system::State;

/// A computed motion that can be evaluated at any time. It stores all steps with their polynomials,
/// as [`Integrator::trajectory`](super::Integrator::trajectory) or an observer collects them.
///
/// States are identical, bit for bit, to those of [`DenseStep::eval`] in the run. Each step takes
/// the memory of its two ends and of one state per term of its polynomial: 8 or 9 for the explicit
/// pairs, one per stage for Gauss methods, one per order for Taylor series.
///
/// With the feature `serde` it can be serialised and deserialised. Data that are read are checked:
/// an error names the field that is inconsistent with the others.
///
/// # Examples
///
/// ```
/// use branched_pendulum::prelude::*;
/// use branched_pendulum::system::OdeFn;
///
/// let oscillator = OdeFn::new(2, |_time: f64, y: &[f64], rates: &mut [f64]| {
///     rates[0] = y[1];
///     rates[1] = -y[0];
/// });
/// let method = Dop853::new(Options::with_tolerance(1e-12));
/// let start = State::at_rest(0.0, &[1.0]);
/// let motion = method.trajectory(&oscillator, &start, 10.0)?;
/// let (time, mut rates) = (7.3_f64, [0.0; 2]);
/// assert!((motion.at(time)?[0] - time.cos()).abs() < 1e-11);
/// motion.derivative_into(time, &mut rates)?;
/// assert!((rates[1] + time.cos()).abs() < 1e-9);
/// assert!(motion.at(10.1).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "read::Unchecked<T>",
        bound(deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct Trajectory<T> {
    dimension: usize,
    /// Start time, followed by the end time of each step.
    times: Vec<T>,
    steps: Vec<Kept<T>>,
    /// Values of the first state, then those of each step: its start, its end, and the two lists of
    /// terms of its polynomial.
    numbers: Vec<T>,
}

/// A stored step, without its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Kept<T> {
    form: Form,
    length: T,
    /// Place of its first number.
    first: usize,
    /// Numbers of values in the two lists of terms of its polynomial.
    terms: [usize; 2],
}

impl<T: Real> Trajectory<T> {
    /// Creates a trajectory that consists of the state `start` only.
    pub fn new(start: State<T>) -> Self {
        Self {
            dimension: start.values.len(),
            times: vec![start.time],
            steps: Vec::new(),
            numbers: start.values,
        }
    }

    /// Adds a step, which must start at the end of the trajectory.
    ///
    /// # Errors
    ///
    /// [`DenseError`], if the step starts elsewhere, if its state has another length, or if its
    /// values cannot be computed.
    pub fn push(&mut self, step: &mut DenseStep<'_, T>) -> Result<(), DenseError<T>> {
        let (start, end) = (step.start_time(), step.end_time());
        let turns = self.times.len() > 1 && (self.end_time() > self.start_time()) != (end > start);
        if start != self.end_time() || turns {
            let time = self.end_time();
            return Err(DenseError::OutsideStep { time, start, end });
        }
        let piece = step.polynomial()?;
        if piece.start.len() != self.dimension {
            return Err(DenseError::Length {
                expected: self.dimension,
                found: piece.start.len(),
            });
        }
        self.times.push(end);
        self.steps.push(Kept {
            form: piece.form,
            length: piece.length,
            first: self.numbers.len(),
            terms: piece.terms.map(<[T]>::len),
        });
        for numbers in [piece.start, piece.end, piece.terms[0], piece.terms[1]] {
            self.numbers.extend_from_slice(numbers);
        }
        Ok(())
    }

    /// Time of the start.
    pub fn start_time(&self) -> T {
        self.times.first().copied().unwrap_or(T::NAN)
    }

    /// Returns the end time, which is before the start time in a run backwards.
    pub fn end_time(&self) -> T {
        self.times.last().copied().unwrap_or(T::NAN)
    }

    /// Returns the times of the start and of the ends of all steps, in the order of the run.
    pub fn times(&self) -> &[T] {
        &self.times
    }

    /// Returns the state at `time`. At the end of a step it is identical, bit for bit, to the state
    /// of the run.
    ///
    /// # Errors
    ///
    /// [`DenseError::OutsideStep`] if `time` is outside of the trajectory.
    pub fn at(&self, time: T) -> Result<Vec<T>, DenseError<T>> {
        let mut values = vec![T::ZERO; self.dimension];
        self.at_into(time, &mut values)?;
        Ok(values)
    }

    /// Writes the state at `time` to `out`.
    ///
    /// # Errors
    ///
    /// As [`at`](Self::at), and if `out` does not have the length of the state.
    pub fn at_into(&self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        match self.piece(time) {
            Some((ends, piece)) => piece.at(ends, time, out),
            // Before its first step it has a state at one time.
            None if self.steps.is_empty() && time == self.start_time() => {
                let start = Piece::resting(&self.numbers);
                start.at([time; 2], time, out)
            }
            None => Err(self.outside(time)),
        }
    }

    /// Writes the derivative of the state at `time` to `out`, as [`DenseStep::derivative`] does;
    /// where two steps meet, the derivative in the earlier step.
    ///
    /// # Errors
    ///
    /// As [`at_into`](Self::at_into); also if the trajectory has no steps.
    pub fn derivative_into(&self, time: T, out: &mut [T]) -> Result<(), DenseError<T>> {
        let Some((ends, piece)) = self.piece(time) else {
            return Err(self.outside(time));
        };
        piece.derivative_at(ends, time, out)
    }

    fn outside(&self, time: T) -> DenseError<T> {
        DenseError::OutsideStep {
            time,
            start: self.start_time(),
            end: self.end_time(),
        }
    }

    /// Returns the first step that contains `time`, and the times of its ends.
    fn piece(&self, time: T) -> Option<([T; 2], Piece<'_, T>)> {
        let forwards = self.end_time() >= self.start_time();
        let before = |end: &T| if forwards { *end < time } else { *end > time };
        let ends = self.times.get(1..)?;
        let index = ends.partition_point(before);
        let ends = [*self.times.get(index)?, *ends.get(index)?];
        let inside = (ends[0] <= time && time <= ends[1]) || (ends[1] <= time && time <= ends[0]);
        if !inside {
            return None;
        }
        let kept = self.steps.get(index)?;
        let numbers = self.numbers.get(kept.first..)?;
        let (start, numbers) = numbers.split_at_checked(self.dimension)?;
        let (end, numbers) = numbers.split_at_checked(self.dimension)?;
        let (terms, numbers) = numbers.split_at_checked(kept.terms[0])?;
        let piece = Piece {
            form: kept.form,
            start,
            end,
            terms: [terms, numbers.get(..kept.terms[1])?],
            length: kept.length,
        };
        Some((ends, piece))
    }
}
