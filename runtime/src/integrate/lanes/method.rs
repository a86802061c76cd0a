//! Traits of methods that integrate trajectories in lanes.

// Users name the trait of methods as a bound, and none of the types that it mentions.
#![allow(unreachable_pub)]

use alloc::vec::Vec;

use super::models::Models;
use super::runs::{Flags, Runs};
use crate::integrate::error::InputError;
use crate::integrate::right_hand_side::StepSpan;
use crate::integrate::steps::Failure;
use crate::scalar::Lane;
use crate::simd::Simd;
use crate::system::CastOde;

/// A method that integrates systems of the type `O` in the lanes of vector registers, for
/// [`Ensemble`](crate::ensemble::Ensemble). The explicit Runge–Kutta pairs ([`Dop853`], [`Dopri5`],
/// [`Verner98`]), [`Rk4`] and [`Gauss`] integrate any [`CastOde`]; [`Taylor`] integrates models in
/// absolute angles that provide their Taylor coefficients.
///
/// Other crates cannot implement this trait.
///
/// [`Dop853`]: crate::integrate::Dop853
/// [`Dopri5`]: crate::integrate::Dopri5
/// [`Gauss`]: crate::integrate::Gauss
/// [`Rk4`]: crate::integrate::Rk4
/// [`Taylor`]: crate::integrate::Taylor
/// [`Verner98`]: crate::integrate::Verner98
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not integrate `{O}` in lanes",
    note = "in lanes go `Dop853`, `Verner98`, `Dopri5`, `Rk4` and `Gauss`, with any `CastOde`, and `Taylor`, with `AbsoluteAngles` of models that say `emit(taylor)`",
    note = "all other methods go by `Ensemble::integrate`, start by start on all threads"
)]
pub trait LaneMethod<O: CastOde<T>, T: Lane>: Sync {
    /// Data of the method that lasts for a run.
    #[doc(hidden)]
    type Steps<R: Simd<T>>: LaneSteps<T, R, System = O>;

    /// Checks that the options suit states of `dimension` components.
    #[doc(hidden)]
    fn check(&self, dimension: usize) -> Result<(), InputError<T>>;

    /// Checks that the method's tolerances do not need more digits than the start has.
    #[doc(hidden)]
    fn check_start(&self, values: &[T]) -> Result<(), InputError<T>> {
        let _ = values;
        Ok(())
    }

    /// Allocates the data of the method, with the system `system` in every lane.
    #[doc(hidden)]
    fn steps<R: Simd<T>>(&self, system: &O) -> Self::Steps<R>;
}

/// Data of a method that integrates one trajectory in each lane.
pub trait LaneSteps<T: Lane, R: Simd<T>> {
    /// Type of the system in each lane.
    type System: CastOde<T>;

    /// Returns the systems of all lanes.
    fn models(&mut self) -> &mut Models<Self::System, T, R>;

    /// Sets the state of the trajectory in a lane. `None` sets zeros, whose sines and cosines are
    /// computed faster than those of NaN.
    fn set(&mut self, lane: usize, values: Option<&[T]>);

    /// Returns the states of all lanes at the start of the step.
    fn start(&self) -> &[R];

    /// Returns the states of all lanes at the end of the step.
    fn end(&self) -> &[R];

    /// Chooses the step lengths that do not follow from a previous step. `fresh` marks the lanes
    /// that have none.
    fn prepare(&mut self, runs: &mut Runs<T>, fresh: &Flags);

    /// Plans lengths and ends of the steps of all lanes. Returns the lanes whose step is not
    /// allowed.
    fn plan(&mut self, runs: &mut Runs<T>) -> Flags;

    /// Returns the reason why the planned step of a lane is not allowed; `None` if it is allowed.
    fn why_stuck(&self, runs: &Runs<T>, lane: usize) -> Option<Failure<T>>;

    /// Makes a step in all lanes; `size` holds the absolute values of the step lengths.
    fn attempt(&mut self, span: StepSpan<R>, size: R);

    /// Accepts or rejects the steps, counts them, and chooses the next step lengths if they follow
    /// from these steps. Returns the lanes whose step is accepted.
    fn judge(&mut self, runs: &mut Runs<T>) -> Flags;

    /// Computes the coefficients of the dense output of all lanes.
    fn prepare_dense(&mut self, span: StepSpan<R>);

    /// Counts the evaluations that the dense output took in a lane, and checks that it is finite.
    ///
    /// # Errors
    /// Time and state at which the rates are not finite.
    fn judge_dense(&self, runs: &mut Runs<T>, lane: usize) -> Result<(), (T, Vec<T>)>;

    /// Writes the solutions within the steps, each at a fraction (0 to 1) of its step.
    fn value(&self, fraction: R, out: &mut [R]);

    /// Makes the end of each accepted step the start of the next one.
    fn advance(&mut self, accepted: R::Mask);
}
