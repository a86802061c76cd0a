//! Studies of the project itself as a library, so that tests can call them.
//!
//! Each program in `src/bin` is a thin shell around one module here; but for
//! `evaluation-speed`, whose many scenes take long to compile and whose modules are
//! its own.

pub mod advise;
pub mod integration_speed;
pub mod scenes;
pub mod solvers;
pub mod stability_map;
pub mod swaying_branch;
pub mod tree_thresholds;
pub mod work_precision;
