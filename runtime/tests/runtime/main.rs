//! Tests of the runtime that need no macro: integrator against known answers
//! and the reference trajectories, its failures, analysis.

#![cfg(feature = "std")]

mod accuracy;
mod animation;
mod backwards;
mod continuation;
mod dense_regression;
mod ensemble;
mod events;
mod exponents;
mod failures;
mod gauss;
#[cfg(feature = "spectra")]
mod lacking_friction;
mod lines;
mod modes;
mod normal;
mod order;
mod problems;
mod projection;
mod reference;
mod requests;
mod restarts;
mod sector_modes;
#[cfg(feature = "serde")]
mod serde;
mod smoothing;
#[cfg(feature = "spectra")]
mod spectrum;
mod stability;
mod statistics;
mod stepper;
mod taylor;
mod trajectory;
mod variational;
mod workspace;
