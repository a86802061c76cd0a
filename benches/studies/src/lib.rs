//! Studies of the project itself as a library, so that tests can call them.
//!
//! Each program in `src/bin` only calls one module of this library.

pub mod accuracy_cost;
pub mod scenes;
pub mod solvers;
pub mod stability_map;
pub mod swaying_branch;
pub mod tree_thresholds;
pub mod work_precision;
