//! Parameters from measured and simulated motions.

mod bounds;
pub(crate) mod chain;
mod deviations;
mod frequencies;
mod measured;
mod mistakes;
mod refusals;
mod releases;
mod searches;
mod simulated;
