//! Names that a first program needs, in one `use`: to describe a tree, integrate it, evaluate its
//! energy, and compute many states or many trajectories. All other items are imported by their
//! paths.
//!
//! If another prelude also has a `State` or an `Options`, add `use
//! branched_pendulum::prelude::State;` to choose one.

pub use core::ops::ControlFlow;

pub use crate::batch::Batch;
#[cfg(feature = "macros")]
pub use crate::branched_pendulum;
#[cfg(feature = "std")]
pub use crate::ensemble::Ensemble;
pub use crate::integrate::{
    AdjointMethod, DenseStep, Dop853, Dopri5, Gauss, GaussOrder, IntegrationError, Integrator,
    Method, Options, Report, Rk4, Solution, StopReason, Taylor, Verner98,
};
pub use crate::model::{ParameterError, Transfer};
pub use crate::scalar::{Real, Scalar};
pub use crate::system::{
    AbsoluteAngles, CanonicalVariables, Energy, FirstIntegral, Model, Ode, Pendulum, Positions,
    Prescribed, State, SymmetricCoordinates, SymmetricPendulum,
};
