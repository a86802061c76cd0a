//! The command `branched-pendulum` as a library, so that tests can call what it does, and so that
//! other programs start, show their progress, keep their results and end as it does ([`frame`]).

pub mod budget;
pub mod commands;
pub mod failure;
pub mod film;
pub mod frame;
pub mod measured_file;
pub mod motion;
pub mod quadrature;
pub mod release;
mod shipped;
pub mod smoothed;
pub mod subject;
pub mod windows;

pub use commands::main;
pub use failure::Failure;
pub use frame::{Arguments, Job, Progress};
