//! How wrong is each form of the energy transfer W into the antiphase mode, at
//! which amplitude of that mode, and what does each form cost?
//!
//! The apparatus is that of [`branched_double`](crate::branched_double).
//!
//! - [`arguments`]: the command line,
//! - [`forms`]: the scene, and all forms of W at one state,
//! - [`error_curve`]: relative error against amplitude, and where it passes a
//!   given value,
//! - [`phase_average`]: states with random phases, [`trajectories`]: states
//!   along exact motions,
//! - [`cost`]: time for one evaluation,
//! - [`nested`]: phase average and cost for a tree of nested copies,
//! - [`output`]: how it is shown.

pub mod arguments;
pub mod cost;
pub mod error_curve;
pub mod forms;
pub mod nested;
pub mod output;
pub mod phase_average;
pub(crate) mod random;
pub mod trajectories;

pub use arguments::{ArgumentError, Arguments, Request};
pub use cost::Costs;
pub use error_curve::{Crossing, Point};
pub use forms::{Apparatus, FORMS};
