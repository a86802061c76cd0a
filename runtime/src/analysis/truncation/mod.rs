//! Errors of approximate forms of the energy transfer W, as a function of the amplitude of the
//! coordinates that they assume to be small.
//!
//! They are computed for any tree that has several forms of W ([`ComparedForms`]). The error is,
//! for each sector and amplitude, the rms of (W − W_exact) divided by the rms of W_exact, averaged
//! in one of two ways:
//!
//! - [`PhaseAverage`]: over random states whose differences oscillate with that amplitude. The
//!   states of two amplitudes differ in nothing else, so that the curves are smooth and their
//!   slopes show the order of the remainder.
//! - [`AlongTrajectories`]: over exact motions, with states binned by their amplitude. These are
//!   the states that occur in motions, with the frequencies at which they occur.
//!
//! The *amplitude* of a state, in rad, is the largest √(q² + (q̇/Ω)²) of all small differences q,
//! with the angular frequency Ω of their sector ([`sector_frequencies`]). For a sector of one
//! coordinate it is the amplitude of the linear oscillation through the state. All coordinates that
//! are not small are the *background* ([`Background`]): the means, and differences that the forms
//! do not expand.
//!
//! Errors are relative to W, which is of second order in the amplitude. Therefore a form up to the
//! order N in the amplitude has an error of order N − 1 at least, and of order N if W has no odd
//! orders (pairs that contain no pairs).
//!
//! # Examples
//!
//! This example finds the amplitude at which the error of W into the antiphase motion of the
//! paper's pendulum reaches 1 %:
//!
#![cfg_attr(feature = "macros", doc = "```")]
#![cfg_attr(not(feature = "macros"), doc = "```ignore")]
//! use branched_pendulum::analysis::truncation::{Background, LevelCrossing, PhaseAverage, logarithmic};
//! use branched_pendulum::prelude::*;
//!
//! #[branched_pendulum(
//!     gravity = 9.80665,
//!     parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
//!         child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
//!     ],
//!     emit(transfer(amplitude = 2, amplitude = 4, exact)),
//! )]
//! struct BranchedDouble;
//!
//! let model = BranchedDouble::new();
//! let average = PhaseAverage {
//!     amplitudes: logarithmic([0.01, 1.0], 21),
//!     states: 1000,
//!     seed: 0,
//!     background: Background::visited(&model, &[47.8_f64.to_radians(), 0.0, 0.0], 10.0)?,
//! };
//! let curves = average.curves(&model)?;
//! assert_eq!(curves[0].receiver, "d");
//! let Some(LevelCrossing::At(amplitude)) = curves[0].crossing(0, 0.01) else { unreachable!() };
//! assert!((amplitude - 0.16).abs() < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod background;
mod curve;
mod error;
mod forms;
mod motion;
mod phase_average;
mod trajectories;

pub use background::Background;
pub use curve::{ErrorCurve, ErrorPoint, LevelCrossing};
pub use error::TruncationError;
pub use forms::{ComparedForms, TreeForms, TruncatedSector};
pub use motion::{amplitude, sector_frequencies};
pub use phase_average::{CanonicalState, PhaseAverage};
pub use trajectories::AlongTrajectories;

/// Returns `count` values in geometric progression from `low` to `high`, both positive.
#[must_use]
pub fn logarithmic([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count)
        .map(|index| low * (high / low).powf(index as f64 / last))
        .collect()
}

/// Returns the indices of the coordinates that are small differences.
fn small_coordinates(model: &impl ComparedForms) -> Vec<usize> {
    let indices = model.truncated_sectors().into_iter();
    let indices = indices.flat_map(|small| small.coordinates);
    indices
        .filter(|&index| index < model.coordinates())
        .collect()
}
