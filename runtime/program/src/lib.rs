//! The program `branched-pendulum` as a library, so that tests can call its functions.

pub mod budget;
pub mod commands;
pub mod constants;
pub mod measured_file;
pub mod motion;
pub mod picture;
pub mod release;
pub mod rest;
pub mod shipped;
pub mod smoothed;
pub mod subject;

pub(crate) use branched_pendulum_frame as frame;
pub(crate) use branched_pendulum_frame::Failure;
pub use commands::main;
