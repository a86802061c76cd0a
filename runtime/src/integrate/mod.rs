//! Integration of the equations of motion.
//!
//! One method so far: [`Dop853`], an explicit Runge–Kutta method of order 8
//! with adaptive steps and dense output of order 7. Steps are chosen by the
//! error alone; an observer sees each accepted step as a [`DenseStep`] and may
//! evaluate it anywhere inside, so that output never shortens a step.
//!
//! Every run ends with a [`Report`]; a run that fails ends with an
//! [`IntegrationError`] that carries the last good state.

mod control;
mod dop853;
mod error;
mod options;
mod report;
mod request;

pub use dop853::{DenseError, DenseStep, Dop853};
pub use error::{InputError, IntegrationError};
pub use options::{Options, Tolerance};
pub use report::{Report, Solution, StopReason};
