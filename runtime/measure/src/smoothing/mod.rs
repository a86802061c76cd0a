//! Angles, velocities and accelerations behind measured angles, with their errors.
//!
//! [`KinematicSmoother`] knows of the motion only that it is smooth: its jerk is white noise
//! (physics §16), so that the estimate is the quintic smoothing spline of the data. How much
//! noise and how much jerk there is, it finds out by likelihood. [`ModelSmoother`] knows the
//! equations of motion, [`LocalPolynomials`] nothing: a cross-check. A [`SmoothedMotion`] gives
//! means and standard deviations, and draws: motions that the data allow, as likely as they
//! are; [`SmoothedCoordinates`] those of several coordinates. What does not follow linearly
//! from the motion (energies, W, its integral over time) is computed from draws, by [`bands`]
//! and [`running_integral`].
//!
//! Smooth symmetric coordinates, not links' own angles: differences of identical branches
//! are smaller and slower than the angles, and what belongs to both is not noise of either.

mod bands;
mod constants;
mod coordinates;
mod disturbances;
mod error;
mod gaussian;
mod integral;
mod kinematic;
mod likelihood;
mod model;
mod model_filter;
mod polynomials;
mod series;

pub use bands::{Bands, bands};
pub use coordinates::SmoothedCoordinates;
pub use error::SmoothingError;
pub(crate) use error::misplaced;
pub use integral::running_integral;
pub use kinematic::KinematicSmoother;
pub use model::ModelSmoother;
pub use polynomials::LocalPolynomials;
pub use series::SmoothedMotion;
