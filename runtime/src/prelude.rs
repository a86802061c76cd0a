//! Names of a first program, in one `use`: describe a tree, integrate it, look
//! at its energy, compute many states and many trajectories. Everything else is
//! named by its path.
//!
//! Where another prelude has a `State` or an `Options` as well,
//! `use branched_pendulum::prelude::State;` beside the two says which is meant.

pub use core::ops::ControlFlow;

pub use crate::batch::Batch;
#[cfg(feature = "macros")]
pub use crate::branched_pendulum;
#[cfg(feature = "std")]
pub use crate::ensemble::Ensemble;
pub use crate::integrate::{
    DenseStep, Dop853, Dopri5, Gauss, GaussOrder, IntegrationError, Integrator, Method, Options,
    Report, Rk4, Solution, StopReason, Taylor, Verner98,
};
pub use crate::model::{ParameterError, Transfer};
pub use crate::scalar::{Real, Scalar};
pub use crate::system::{
    AbsoluteAngles, Canonical, CanonicalVariables, Energy, FirstIntegral, Forced, Model, Ode,
    Pendulum, Positions, Prescribed, State, SymmetricCoordinates, SymmetricPendulum,
};
