//! What a program that integrates pendulums uses, in one `use`.

#[cfg(feature = "macros")]
pub use crate::branched_pendulum;
pub use crate::integrate::{
    DenseStep, Dop853, IntegrationError, Options, Report, Solution, StopReason, Tolerance,
};
pub use crate::model::{ParameterError, Transfer};
pub use crate::scalar::{Real, Scalar};
pub use crate::sectors::{Budget, Sectors};
pub use crate::system::{
    AbsoluteAngles, Energy, Ode, OdeFn, Pendulum, State, SymmetricCoordinates, SymmetricPendulum,
};
