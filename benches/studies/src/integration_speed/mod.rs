//! The cost of a trajectory to a given error, for the comparison with heyoka.
//!
//! `benches/peers/heyoka_trajectory.py` measures the same problems.

pub mod ensemble;
pub mod measure;
