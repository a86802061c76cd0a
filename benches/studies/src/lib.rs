//! Studies of the project itself as a library, so that tests can call them.
//!
//! Each program in `src/bin` is a thin shell around one module here; but for
//! `evaluation-speed`, whose many scenes take long to compile and whose modules are
//! its own.

pub mod advise;
pub mod critical_angle;
pub mod integration_speed;
pub mod release_map;
pub mod scenes;
pub mod solvers;
pub mod stability_map;
pub mod swaying_branch;
pub mod transfer_orders;
pub mod work_precision;
