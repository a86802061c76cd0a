//! The cost of computing a trajectory to a given error, for the comparison with the integrator
//! heyoka.
//!
//! `benches/peers/heyoka_trajectory.py` measures the same problems.

pub mod ensemble;
pub mod measure;
