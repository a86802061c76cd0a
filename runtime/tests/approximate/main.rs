//! Models that are cheaper than the full one, and frames in real time.

#![cfg(all(feature = "std", feature = "macros"))]

mod energy;
mod error;
mod frames;
mod nearly;
mod propagator;
mod scenes;
mod switched;
