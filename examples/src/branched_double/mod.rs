//! The paper's experiment: a parent link with two equal children, released
//! from rest with the children hanging straight down, so that only the
//! in-phase modes are excited. Does the antiphase mode grow, and where does
//! its energy come from?
//!
//! Y. Toda and T. Ooshida, "Experimental detection of energy transfer into the
//! anti-phase mode in a branched double pendulum", called *the paper* below.
//!
//! - [`arguments`], [`help`]: the command line,
//! - [`apparatus`]: the two scenes, and what is measured at one instant,
//! - [`experiment`]: one run from release to the last sample,
//! - [`findings`]: what a run says, [`terms`]: the terms of W one by one,
//! - [`table`], [`files`], [`charts`]: how it is shown.

pub mod apparatus;
mod argument_error;
pub mod arguments;
pub mod charts;
pub mod experiment;
pub mod failure;
pub mod files;
pub mod findings;
pub mod help;
pub mod progress;
pub mod scenes;
pub mod table;
pub mod terms;

pub use apparatus::{Apparatus, Flow, Friction, Sample};
pub use argument_error::ArgumentError;
pub use arguments::{Arguments, Precision, Request};
pub use experiment::{Run, Work};
pub use failure::Failure;
pub use findings::{Findings, Frequencies};
