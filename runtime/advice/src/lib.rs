//! Advice: the cheapest combination of model, method, setting and scalar type with which the
//! required outputs are right, measured on the user's machine.
//!
//! An [`Advisor`] knows the scene: its exact equations, its starts, how long it is
//! followed, which outputs must be right and how right ([`Wanted`]). [`Candidates`] are
//! what it chooses among: models with methods, or anything else that goes from a state
//! to states ([`Candidate`]). The [`Advice`] says which to take, with the error and the
//! cost that were measured, what comes next, why what is cheaper will not do, and what
//! to write.
//!
//! Errors are those against a reference that is good to a hundredth of the tolerances,
//! whose error is estimated: two methods in `f64` where they agree as well, else
//! extrapolation in double-double numbers. Where the motion is chaotic, no digit is left
//! of what `f64` knew of the start after a while, with every method: values are
//! compared up to there, and beyond a quantity that is kept, or means. The advice says
//! which.
//!
//! Where the model is settled, [`WorkPrecision`] has error against time for every method on one motion, and
//! [`KnownEnd`] where it ends.
//!
//! # Examples
//!
//! ```
//! use branched_pendulum_advice::{Advisor, Candidates, ModelForm, Wanted};
//! use branched_pendulum::prelude::*;
//!
//! #[branched_pendulum(
//!     gravity = 9.80665,
//!     stem: rod(mass = 0.2, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 2],
//! )]
//! struct Branch;
//!
//! /// The same with its twigs in phase.
//! #[branched_pendulum(
//!     gravity = 9.80665,
//!     stem: rod(mass = 0.2, length = 0.3) [twig: rod(mass = 0.1, length = 0.2) * 2],
//!     in_phase(twig)
//! )]
//! struct InPhase;
//!
//! let (branch, in_phase) = (Branch::new(), InPhase::new());
//! let advice = Advisor::new(&AbsoluteAngles(&branch))
//!     .start(State::at_rest(0.0, &[0.3, 0.1, 0.1]))
//!     .until(2.0)
//!     .wanted(Wanted::angles(1e-4))
//!     .advise(
//!         &Candidates::new()
//!             .rates(&ModelForm::new("full"), AbsoluteAngles(&branch))
//!             .rates(
//!                 &ModelForm::new("in phase").entry("in_phase(twig)").reduced(InPhase::WHOLE),
//!                 AbsoluteAngles(&in_phase),
//!             ),
//!     )?;
//! println!("{advice}");
//! assert!(advice.chosen().is_some_and(|chosen| chosen.is_right()));
//! # Ok::<(), branched_pendulum_advice::AdviceError>(())
//! ```

mod advisor;
mod by_frames;
mod candidate;
mod candidates;
mod choice;
mod comparison;
mod error;
mod extrapolation;
mod form;
#[cfg(feature = "trees")]
mod frames;
mod integrated;
mod paths;
mod report;
mod search;
#[cfg(feature = "trees")]
mod tree;
mod truth;
mod wanted;
mod work_precision;

pub use advisor::Advisor;
pub use candidate::{Candidate, CandidateName, SettingRange, Visit};
pub use candidates::Candidates;
pub use choice::{Measured, TimeLimit, pareto};
pub use comparison::{Criterion, Worst};
pub use error::AdviceError;
pub use form::ModelForm;
pub use report::{Advice, Followed};
#[cfg(feature = "trees")]
pub use tree::{TreeOutput, TreeScene, UnknownOutput};
pub use wanted::Wanted;
pub use work_precision::{KnownEnd, MethodRun, WorkPrecision};
