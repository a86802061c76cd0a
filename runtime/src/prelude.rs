//! What a program that integrates pendulums uses, in one `use`.

#[cfg(feature = "macros")]
pub use crate::branched_pendulum;
pub use crate::integrate::{
    Crossing, DenseStep, Dop853, Dopri5, Event, Gauss, GaussOrder, IntegrationError, Integrator,
    Options, Projected, Report, Rk4, Solution, Solver, StoermerVerlet, StopReason, Taylor,
    Tolerance, Verner98,
};
pub use crate::model::{ParameterError, Transfer};
pub use crate::scalar::{Real, Scalar};
pub use crate::sectors::{Budget, Sectors};
pub use crate::system::{
    AbsoluteAngles, Canonical, CanonicalEnergy, CanonicalVariables, Cast, Energy, FirstIntegral,
    Ode, OdeFn, Pendulum, State, SymmetricCoordinates, SymmetricPendulum, TaylorOde,
    TaylorPendulum,
};
pub use crate::transfer_forms::{TransferForm, TransferForms};
