//! The traits of methods that work in lanes.

// A user names the trait of the methods as a bound, and nothing it is made of.
#![allow(unreachable_pub)]

use alloc::vec::Vec;

use super::models::Models;
use super::runs::{Flags, Runs};
use crate::integrate::error::InputError;
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::steps::Failure;
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::LaneOde;

/// A method that integrates systems of the type `O` in the lanes of vector
/// registers, for [`Ensemble`](crate::ensemble::Ensemble): the explicit
/// Runge–Kutta pairs ([`Dop853`], [`Dopri5`], [`Verner98`]), [`Rk4`] and [`Gauss`] any
/// [`LaneOde`], [`Taylor`] absolute angles of models that give their Taylor coefficients.
///
/// No other crate can implement it.
///
/// [`Dop853`]: crate::integrate::Dop853
/// [`Dopri5`]: crate::integrate::Dopri5
/// [`Gauss`]: crate::integrate::Gauss
/// [`Rk4`]: crate::integrate::Rk4
/// [`Taylor`]: crate::integrate::Taylor
/// [`Verner98`]: crate::integrate::Verner98
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not integrate `{O}` in lanes",
    note = "in lanes go `Dop853`, `Verner98`, `Dopri5`, `Rk4` and `Gauss`, with any `LaneOde`, and `Taylor`, with `AbsoluteAngles` of models that say `emit(taylor)`",
    note = "all other methods go by `Ensemble::integrate`, start by start on all threads"
)]
pub trait LaneMethod<O: LaneOde<T>, T: Lane>: Sync {
    /// The method at work.
    #[doc(hidden)]
    type Steps<R: Simd<T>>: LaneSteps<T, R, System = O>;

    /// Passes a method whose options suit states of `dimension` components.
    #[doc(hidden)]
    fn check(&self, dimension: usize) -> Result<(), InputError<T>>;

    /// Passes a start that has the digits that the method needs.
    #[doc(hidden)]
    fn check_start(&self, values: &[T]) -> Result<(), InputError<T>> {
        let _ = values;
        Ok(())
    }

    /// Returns the memory, with this system in every lane.
    #[doc(hidden)]
    fn steps<R: Simd<T>>(&self, system: &O) -> Self::Steps<R>;
}

/// A method at work, with a state in each lane.
pub trait LaneSteps<T: Lane, R: Simd<T>> {
    /// Whose motion it steps along.
    type System: LaneOde<T>;

    /// The systems in the lanes.
    fn models(&mut self) -> &mut Models<Self::System, T, R>;

    /// Puts a state into a lane. Without one the lane gets zeros, of which
    /// sines and cosines are sooner done than of what is not finite.
    fn set(&mut self, lane: usize, values: Option<&[T]>);

    /// The states at the start of the step.
    fn start(&self) -> &[R];

    /// The states at the end of the step.
    fn end(&self) -> &[R];

    /// Chooses steps as far as the step before has not; `fresh` lanes have not
    /// made one.
    fn prepare(&mut self, runs: &mut Runs<T>, fresh: &Flags);

    /// Plans the steps of all lanes: their lengths and their ends. Returns the lanes whose
    /// step may not be tried.
    fn plan(&mut self, runs: &mut Runs<T>) -> Flags;

    /// Why the step of such a lane may not be tried.
    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>>;

    /// Makes a step in all lanes; `size` is its length.
    fn attempt(&mut self, span: StepSpan<R>, size: R);

    /// Judges the steps that were made: counts them, chooses the next ones where
    /// these follow from them, and returns which are accepted.
    fn judge(&mut self, runs: &mut Runs<T>) -> Flags;

    /// Computes what values inside the step need.
    fn prepare_dense(&mut self, span: StepSpan<R>);

    /// Counts that for a lane.
    ///
    /// # Errors
    /// Time and state where the rates are not finite.
    fn judge_dense(&self, runs: &mut Runs<T>, lane: usize) -> Result<(), (T, Vec<T>)>;

    /// Writes the solutions at these fractions of the steps.
    fn value(&self, fraction: R, out: &mut [R]);

    /// Makes the end of the step the start of the next one in these lanes.
    fn advance(&mut self, accepted: R::Mask);
}
