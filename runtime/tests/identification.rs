//! Parameters from measured and simulated motions.

#![cfg(all(feature = "std", feature = "macros"))]

#[path = "identification/chain.rs"]
mod chain;
#[path = "identification/measured.rs"]
mod measured;
#[path = "identification/mistakes.rs"]
mod mistakes;
#[path = "identification/simulated.rs"]
mod simulated;
