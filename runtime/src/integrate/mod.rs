//! Integration of the equations of motion.
//!
//! Methods that differ in order and cost, and share everything else: the trait
//! [`Integrator`]. Steps are chosen by the error alone; an observer sees each
//! accepted step as a [`DenseStep`] and may evaluate it anywhere inside, so
//! that output never shortens a step.
//!
//! | method | order | dense output | steps | for |
//! |---|---|---|---|---|
//! | [`ExplicitRungeKutta`]: [`Dop853`] and others | 5 to 9 | 4 to 8 | adaptive | most things |
//! | [`Taylor`] | by tolerance | that of the method | adaptive | tolerances down to rounding |
//! | [`Rk4`] | 4 | 3 | fixed | comparison, given steps, many states in lanes |
//! | [`Gauss`] | 2, 4, 6, 8 | 1 to 4 | fixed | energy over long times |
//!
//! [`Projected`] holds the state of [`Gauss`] and [`Rk4`] to a first integral.
//!
//! [`Frames`] is for real time: it cannot fail.
//!
//! [`Method`] is a method by its name, as users of a program write it.
//!
//! Every run ends with a [`Report`]; a run that fails ends with an
//! [`IntegrationError`] that carries the last good state.

mod checkpoint;
mod control;
mod dense;
mod error;
mod evaluator;
mod events;
mod explicit;
mod fixed;
mod frames;
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

pub use checkpoint::Checkpoint;
pub use dense::{DenseError, DenseStep};
pub use error::{InputError, IntegrationError, RunError};
pub use events::{Crossing, Event, Occurrence};
pub use explicit::*;
pub(crate) use fixed::Factored;
pub use fixed::{Gauss, Projected, Rk4, Solver};
pub use frames::{Frames, longest_sub_step};
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
