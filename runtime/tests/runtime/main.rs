//! Tests of the runtime that need no macro: integrator against known answers
//! and the reference trajectories, its failures, analysis.

#![cfg(feature = "std")]

mod accuracy;
mod animation;
mod ensemble;
mod exponents;
mod failures;
mod gauss;
mod horizon;
mod modes;
mod normal;
mod order;
mod problems;
mod projection;
mod reference;
mod restarts;
mod runs;
mod sector_modes;
#[cfg(feature = "serde")]
mod serde;
mod stability;
mod statistics;
mod trajectory;
mod variational;
