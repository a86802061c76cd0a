//! Models that are cheaper than the full one, each with a measured error.
//!
//! - [`Linear`]: small motions about an equilibrium, in modes,
//! - [`Linear::truncate`]: the slow modes of a linear model,
//! - [`LinearFrames`]: exact propagation of a linear model, frame by frame,
//! - [`NearlyInPhase`]: copies with small differences from their motion in phase,
//! - [`Switched`]: an approximation while its error is small enough, otherwise the full model.

mod about;
mod error;
mod frames;
mod linear;
mod matrix;
mod measured;
mod nearly;
pub(crate) mod rest;
mod slopes;
mod small_error;
mod switched;

pub use error::LinearError;
pub use frames::LinearFrames;
pub use linear::Linear;
pub use nearly::NearlyInPhase;
pub use switched::{SwitchLog, Switched};

use crate::scalar::Real;

/// An approximate model that advances full states by frames of one length, and estimates its own
/// error against the full model.
///
/// States are the angles (rad) followed by the angular velocities (rad/s), as in
/// [`AbsoluteAngles`](crate::system::AbsoluteAngles). For states and torques of another length the
/// results are NaN.
pub trait Approximation<T: Real> {
    /// Returns the length of a frame, s.
    fn frame(&self) -> T;

    /// Advances a state by one frame.
    fn step(&mut self, state: &mut [T]);

    /// Returns an estimate of the relative error over the second after a state: the largest error
    /// of an angle against the full model, divided by the amplitude of all angles. It does not
    /// evaluate the full model, and so is cheap.
    ///
    /// For [`NearlyInPhase`], see its documentation on how the estimate compares with errors. For
    /// [`LinearFrames`] the estimate is between 0.8 and 12 times the error in a test of four trees
    /// with amplitudes up to 0.6 rad; it is too large if light links swing much more than heavy
    /// ones.
    fn validity(&self, state: &[T]) -> T;

    /// Returns the estimate of the error over the second after a state as an angle, in rad. Over t
    /// seconds the error is t times as large, as long as the amplitude stays the same.
    fn error(&self, state: &[T]) -> T;
}

/// An [`Approximation`] that accepts external torques.
pub trait ForcedApproximation<T: Real>: Approximation<T> {
    /// Advances a state by one frame, during which constant torques (N m) act on the links. The
    /// state becomes NaN if the approximation cannot represent the torques.
    fn step_under(&mut self, state: &mut [T], torques: &[T]);
}
