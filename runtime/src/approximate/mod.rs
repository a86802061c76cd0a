//! Models that are cheaper than the full one, each with its error measured.
//!
//! - [`Linear`]: small motions about an equilibrium, in modes,
//! - [`Linear::truncate`]: its slow modes alone,
//! - [`LinearFrames`]: its exact propagation by frames,
//! - [`NearlyInPhase`]: copies with small differences beside their motion in phase,
//! - [`Switched`]: the full model and an approximation in turn, as the error allows.

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

/// A model that moves full states by frames of one length, nearly as the full model
/// does, and knows by how much it does not.
///
/// States are the angles (rad) followed by the angular velocities (rad/s), as
/// [`AbsoluteAngles`](crate::system::AbsoluteAngles) has them. States and torques of
/// another length are answered with NaN.
pub trait Approximation<T: Real> {
    /// Length of a frame, s.
    fn frame(&self) -> T;

    /// Moves a state by one frame.
    fn step(&mut self, state: &mut [T]);

    /// Returns an estimate of the error against the full model over the second that
    /// follows a state: the largest error of an angle, relative to the amplitude of all.
    /// Cheap: no evaluation of the full model.
    ///
    /// [`NearlyInPhase`] says how its own compares with errors. For [`LinearFrames`] it is
    /// between 0.8 and 12 times the error, for amplitudes up to 0.6 rad of the four trees of
    /// a test; too large where light links swing much more than heavy ones do.
    fn validity(&self, state: &[T]) -> T;

    /// Returns the same estimate as an angle, rad. Over other times than a second
    /// errors are as many times as large, as long as the amplitude is.
    fn error(&self, state: &[T]) -> T;
}

/// An [`Approximation`] that takes torques from outside.
pub trait ForcedApproximation<T: Real>: Approximation<T> {
    /// Moves a state by one frame under torques (N m) on each link that stay the same
    /// during it. NaN where it cannot take them.
    fn step_under(&mut self, state: &mut [T], torques: &[T]);
}
