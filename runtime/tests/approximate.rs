//! Models that are cheaper than the full one, and frames in real time.

#![cfg(all(feature = "std", feature = "macros"))]

#[path = "approximate/energy.rs"]
mod energy;
#[path = "approximate/error.rs"]
mod error;
#[path = "approximate/frames.rs"]
mod frames;
#[path = "approximate/nearly.rs"]
mod nearly;
#[path = "approximate/propagator.rs"]
mod propagator;
#[path = "approximate/scenes.rs"]
mod scenes;
#[path = "approximate/switched.rs"]
mod switched;
