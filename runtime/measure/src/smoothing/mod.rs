//! Estimates of angles, velocities and accelerations from noisy measured angles, with their errors.
//!
//! [`KinematicSmoother`] assumes only that the motion is smooth: its jerk is white noise (physics
//! §16), so that the estimate is the quintic smoothing spline of the data. The strengths of noise
//! and jerk are those of maximum likelihood. [`ModelSmoother`] uses the equations of motion;
//! [`LocalPolynomials`] uses no model at all and serves as a cross-check. A [`SmoothedMotion`]
//! gives means and standard deviations, and draws: motions that the data allow, as likely as they
//! are; [`SmoothedCoordinates`] those of several coordinates. What does not follow linearly from
//! the motion (energies, W, its integral over time) is computed from draws, by [`bands`] and
//! [`running_integral`].
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
mod leaps;
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
pub use leaps::LeapSearch;
pub use model::ModelSmoother;
pub use polynomials::LocalPolynomials;
pub use series::SmoothedMotion;
