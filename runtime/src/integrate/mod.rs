//! Integration of the equations of motion.
//!
//! All methods implement the trait [`Integrator`] and differ only in order and cost. The error
//! alone determines the steps. An observer receives each accepted step as a [`DenseStep`], which
//! can be evaluated at any time within the step, so that output never shortens a step.
//!
//! | method | order | dense output | steps | for |
//! |---|---|---|---|---|
//! | [`ExplicitRungeKutta`]: [`Dop853`] and others | 5 to 9 | 4 to 8 | adaptive | most problems |
//! | [`Taylor`] | by tolerance | that of the method | adaptive | tolerances down to rounding |
//! | [`Rk4`] | 4 | 3 | fixed | comparison, given steps, many states in lanes |
//! | [`Gauss`] | 2, 4, 6, 8 | 1 to 4 | fixed | energy over long times |
//!
//! [`Projected`] keeps the state of [`Gauss`] and [`Rk4`] on a level set of a first integral.
//!
//! [`Frames`] is for real time: it never fails.
//!
//! [`Method`] is a method chosen by its name, as users of a program write it.
//!
//! Every run ends with a [`Report`]. A run that fails ends with an [`IntegrationError`] that
//! carries the last good state.

mod adjoint;
mod checkpoint;
mod choice;
mod control;
mod dense;
mod error;
mod evaluator;
mod events;
mod explicit;
mod fixed;
mod frames;
mod horizon;
mod integrator;
#[cfg(feature = "std")]
pub(crate) mod lanes;
mod method;
mod options;
mod piece;
mod registers;
mod report;
mod request;
mod right_hand_side;
mod run;
mod stepper;
mod steps;
mod taylor;
mod trajectory;

pub use adjoint::{AdjointMethod, MotionGradient};
pub use checkpoint::Checkpoint;
pub use choice::{MethodChoice, UnknownChoice};
pub use dense::{DenseError, DenseStep};
pub use error::{InputError, IntegrationError, RunError};
pub use events::{Crossing, Event, Occurrence};
pub use explicit::*;
pub(crate) use fixed::Factored;
pub use fixed::{Gauss, Projected, Rk4, Solver};
pub use frames::{Frames, longest_sub_step};
pub use horizon::Horizon;
pub use integrator::Integrator;
#[cfg(feature = "std")]
pub use lanes::{Ending, LaneMethod};
pub use method::{AnyIntegrator, Method, UnknownMethod};
pub use options::{Options, Tolerance};
pub use piece::GaussOrder;
pub use report::{Report, Solution, StopReason};
pub use stepper::Stepper;
pub use taylor::Taylor;
pub use trajectory::Trajectory;
