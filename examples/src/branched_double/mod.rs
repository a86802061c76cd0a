//! The paper's experiment: a parent link with two equal children, released
//! from rest with the children hanging straight down, so that only the
//! in-phase modes are excited. Does the antiphase mode grow, and where does
//! its energy come from?
//!
//! Y. Toda and T. Ooshida, "Experimental detection of energy transfer into the
//! anti-phase mode in a branched double pendulum", called *the paper* below.
//!
//! - [`arguments`]: the command line,
//! - [`scenes`]: the apparatus, [`apparatus`]: what is measured at one instant,
//! - [`experiment`]: one run from release to the last sample,
//! - [`findings`]: what a run says, [`terms`]: the terms of W one by one,
//!   [`lines`]: those of the spectrum,
//! - [`table`], [`samples`], [`charts`] with `spectrum`, [`growth`], [`film`]: how it is shown.

pub mod apparatus;
pub mod arguments;
pub mod charts;
pub mod experiment;
pub mod film;
pub mod findings;
pub mod growth;
pub mod lines;
pub mod run;
pub mod samples;
pub mod scenes;
mod spectrum;
pub mod table;
pub mod terms;

pub use apparatus::{Apparatus, Flow, Friction, Sample};
pub use arguments::{Arguments, Precision};
pub use experiment::{Run, Work};
pub use findings::{Findings, Frequencies};
