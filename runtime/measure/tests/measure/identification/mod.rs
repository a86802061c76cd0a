//! Parameters from measured and simulated motions.

mod chain;
mod deviations;
mod frequencies;
mod measured;
mod mistakes;
mod refusals;
mod searches;
mod simulated;
