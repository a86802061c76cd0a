//! Integration of the equations of motion.
//!
//! Methods that differ in order and cost, and share everything else: the trait
//! [`Integrator`]. Steps are chosen by the error alone; an observer sees each
//! accepted step as a [`DenseStep`] and may evaluate it anywhere inside, so
//! that output never shortens a step.
//!
//! | method | order | dense output | steps | for |
//! |---|---|---|---|---|
//! | [`Dopri5`] | 5(4) | 4 | adaptive | tolerances above 1e-5 |
//! | [`Dop853`] | 8(5,3) | 7 | adaptive | most things |
//! | [`Verner98`] | 9(8) | 8 | adaptive | tolerances below 1e-10 |
//! | [`Taylor`] | by tolerance | that of the method | adaptive | tolerances down to rounding |
//! | [`Rk4`] | 4 | 3 | fixed | comparison |
//! | [`Gauss`] | 2, 4, 6, 8 | 1 to 4 | fixed | energy over long times |
//! | [`StoermerVerlet`] | 2 | 1 | fixed | H = T(p) + U(q) alone: a single link |
//!
//! [`Projected`] holds the state of [`Gauss`] and [`Rk4`] to a first integral.
//!
//! Every run ends with a [`Report`]; a run that fails ends with an
//! [`IntegrationError`] that carries the last good state.

mod control;
mod dense;
mod error;
mod evaluator;
mod events;
mod explicit;
mod fixed;
mod integrator;
#[cfg(feature = "std")]
pub(crate) mod lanes;
mod options;
mod report;
mod request;
mod sum;
mod taylor;

pub use dense::{DenseError, DenseStep};
pub use error::{InputError, Inseparable, IntegrationError};
pub use events::{Crossing, Event, Occurrence};
pub use explicit::{
    Dop853, Dopri5, DormandPrince5, DormandPrince8, ExplicitRungeKutta, Verner9, Verner98,
};
pub use fixed::{Gauss, GaussOrder, Projected, Rk4, Solver, StoermerVerlet};
pub use integrator::Integrator;
#[cfg(feature = "std")]
pub use lanes::LaneMethod;
pub use options::{Options, Tolerance};
pub use report::{Report, Solution, StopReason};
pub use taylor::Taylor;
