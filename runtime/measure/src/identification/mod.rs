//! Parameters from measured motions and frequencies.
//!
//! Names in a description are parameters of its model; [`Identification`] finds them from angles
//! against time of any links, from frequencies of small motions, or from both. It uses multiple
//! shooting (`docs/identification.md`; H. G. Bock, *Numerical treatment of inverse problems in
//! chemical reaction kinetics*, 1981): first short segments with separate initial states, whose sum
//! of squares is smooth far from the true values, then segments of twice the length, until one
//! motion covers the record, because only long segments show small errors of friction. Derivatives
//! are exact ([`Dual`](branched_pendulum::scalar::Dual)), steps those of Levenberg and Marquardt.
//!
//! # Example
//!
//! The lengths and the friction of two rods, of which only the lower one is seen:
//!
//! ```
//! use branched_pendulum_measure::identification::{AngleRecord, FamilyOf, Identification};
//! use branched_pendulum::prelude::*;
//!
//! #[branched_pendulum(
//!     gravity = 9.80665,
//!     upper: rod(mass = 0.1, length = upper_length, friction = friction) [
//!         lower: rod(mass = 0.1, length = lower_length, friction = friction)
//!     ],
//! )]
//! struct Chain;
//!
//! // In place of a measurement: a motion, 50 pictures a second.
//! let truth = ChainParameters { upper_length: 0.30, lower_length: 0.20, friction: 2e-4 };
//! let times: Vec<f64> = (0..300).map(|picture| f64::from(picture) / 50.0).collect();
//! let start = State::at_rest(0.0, &[0.5, -0.3]);
//! let method = Dop853::new(Options::with_tolerance(1e-10));
//! let motion = method.sample_to_vec(&AbsoluteAngles(Chain::new(truth)?), &start, &times)?;
//! let lower: Vec<Option<f64>> = motion.iter().map(|state| Some(state.values[1])).collect();
//!
//! let record = AngleRecord::new(&times).with_link("lower", &lower, 1e-3);
//! let fit = Identification::new(FamilyOf::<Chain>::new())
//!     .unknown("upper_length", 0.36)
//!     .unknown("lower_length", 0.17)
//!     .unknown("friction", 3e-4)
//!     .fit(&record)?;
//! assert!((fit.determined("upper_length")?.value - 0.30).abs() < 1e-6);
//! assert!((fit.determined("friction")?.value - 2e-4).abs() < 1e-8);
//! println!("{}", fit.identifiability);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod alternatives;
mod compare;
mod convergence;
mod covariance;
mod effort;
mod elimination;
mod error;
mod family;
mod fit;
mod fits;
mod fitted;
mod frequencies;
mod identifiability;
mod least_squares;
mod problem;
mod ratios;
mod record;
mod release;
mod report;
mod resolve;
mod search;
mod sensitivity;
mod start;
mod task;
mod windowed;

pub use convergence::{Convergence, SearchFailure};
pub use effort::{SearchObserver, SearchProgress};
pub use error::IdentificationError;
pub use family::{Family, FamilyOf, ImpossibleValue};
pub use fit::{
    AngleErrors, Fit, FittedFrequency, ParameterEstimate, StageReport, Standing, Unfound,
};
pub use frequencies::Frequency;
pub use identifiability::{Identifiability, OpenChange};
pub use problem::{Identification, Shooting};
pub use ratios::{DIVIDED, TIMES};
pub use record::AngleRecord;
pub use release::Unrest;
pub use resolve::OFFSET_OF;
pub use windowed::{SearchOutcome, WindowedFit, best};
