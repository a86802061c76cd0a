//! Parameters from measured and simulated motions.

#![cfg(all(feature = "std", feature = "macros"))]

#[path = "identification/chain.rs"]
mod chain;
#[path = "identification/deviations.rs"]
mod deviations;
#[path = "identification/measured.rs"]
mod measured;
#[path = "identification/mistakes.rs"]
mod mistakes;
#[path = "identification/refusals.rs"]
mod refusals;
#[path = "identification/searches.rs"]
mod searches;
#[path = "identification/simulated.rs"]
mod simulated;
