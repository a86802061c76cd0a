//! Integrate and analyse branched pendulums: planar trees of rigid links.
//!
//! The attribute `branched_pendulum` (feature `macros`, on by default) derives
//! the equations of motion of a tree from its description and writes them as
//! specialised Rust code. This crate contains the traits and numbers that the code
//! uses, integrators and analyses:
//!
//! - [`scalar`]: numbers with which emitted code computes,
//! - [`system`]: traits that emitted code implements, and states,
//! - [`integrate`]: trajectories, with error control, dense output and events,
//! - [`approximate`]: cheaper models, with their errors,
//! - [`ensemble`]: many trajectories on all cores,
//! - [`interruption`]: computations that can be stopped from outside,
//! - [`batch`]: accelerations of many states, in vector registers,
//! - [`tree`]: large trees, in loops,
//! - [`sectors`]: motion of identical subtrees in phase and against each other,
//! - [`taylor`]: recurrences of Taylor coefficients that emitted code uses,
//! - [`transfer_forms`]: several forms of one energy transfer,
//! - [`analysis`]: linear modes of trees and sectors, averages, growth of deviations,
//!   errors of truncated transfers,
//! - [`model`]: results and errors of emitted models.
//!
//! SI units throughout; angles are absolute, in radians from the downward
//! vertical, or from the upward one in trees that stand (negative gravity).
//!
//! # Example
//!
//! A single rod, with its equation of motion written by hand as the attribute
//! writes it for trees. Released from 30°, the rod returns after one period, which
//! is longer than that of small oscillations.
//!
//! ```
//! use branched_pendulum::prelude::*;
//! use branched_pendulum::system::LinkName;
//!
//! /// A uniform rod of length `length`, in metres.
//! struct Rod<T> {
//!     length: T,
//! }
//!
//! impl<T: Scalar> Model<T> for Rod<T> {
//!     type Of<S: Scalar> = Rod<S>;
//!     const KNOWN_LINKS: Option<usize> = Some(1);
//!
//!     fn links(&self) -> usize {
//!         1
//!     }
//!     fn link_name(&self, index: usize) -> Option<LinkName<'_>> {
//!         (index == 0).then(|| LinkName::listed("rod"))
//!     }
//!     fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Rod<S> {
//!         Rod { length: convert(self.length) }
//!     }
//! }
//!
//! impl<T: Scalar> Pendulum<T> for Rod<T> {
//!     #[inline(always)]
//!     fn evaluate(
//!         &self,
//!         _time: T,
//!         theta: impl Fn(usize) -> T,
//!         _omega: impl Fn(usize) -> T,
//!         mut alpha: impl FnMut(usize, T),
//!     ) {
//!         // (m length^2 / 3) theta'' = -m g (length / 2) sin(theta)
//!         let factor = T::from_f64(1.5 * 9.80665) / self.length;
//!         alpha(0, -(factor * theta(0).sin_cos().0));
//!     }
//! }
//!
//! let rod = Rod { length: 1.0 };
//! let start = State::at_rest(0.0, &[30.0_f64.to_radians()]);
//! let times: Vec<f64> = (0..=200).map(|i| 0.01 * f64::from(i)).collect();
//! let mut angles = Vec::new();
//! let solution = Dop853::new(Options::with_tolerance(1e-12)).sample(
//!     &AbsoluteAngles(&rod),
//!     &start,
//!     &times,
//!     |_time, state| angles.push(state[0]),
//! )?;
//! println!("{}", solution.report);
//!
//! let turn = angles.windows(3).position(|a| a[1] > a[0] && a[1] >= a[2]);
//! let small = 2.0 * std::f64::consts::PI / (1.5 * 9.80665_f64).sqrt();
//! assert_eq!(turn.map(|i| times[i + 1]), Some(1.67));
//! assert!(small < 1.64);
//! # Ok::<(), IntegrationError<f64>>(())
//! ```
//!
//! # Features
//!
//! - `std` (default): all of the crate. Without it, the crate is `no_std` with
//!   `alloc` and offers [`scalar`], [`system`], [`model`], [`batch`], [`tree`],
//!   [`taylor`], [`sectors`], [`transfer`], [`transfer_forms`], [`translational`], [`integrate`] and
//!   [`approximate`].
//! - `libm`: elementary functions for builds without `std`; one of the two is
//!   needed.
//! - `macros` (default): the attribute `branched_pendulum`.
//! - `serde`: states, options, methods, reports and trajectories can be written and
//!   read. Finite numbers keep their bits wherever the format keeps them; of `serde_json`
//!   the feature `float_roundtrip` does so.

#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

#[cfg(feature = "std")]
pub mod analysis;
pub mod approximate;
pub mod batch;
#[doc(hidden)]
pub mod emitted;
#[cfg(feature = "std")]
pub mod ensemble;
mod errors;
pub mod friction;
pub mod integrate;
pub mod interruption;
pub mod model;
pub mod prelude;
mod requirements;
pub mod scalar;
pub mod sectors;
mod simd;
pub mod spring_dampers;
pub mod system;
pub mod taylor;
pub mod transfer;
pub mod transfer_forms;
pub mod translational;
pub mod tree;

// Names in emitted code, at the shortest path.
pub use model::{ParameterError, Transfer, UnknownParameter};
pub use scalar::Scalar;
pub use sectors::{Budget, ScaleBudget, Scales, Sectors};
pub use system::{
    Energy, Model, Parametric, Pendulum, Positions, Prescribed, SmallDifferences,
    SymmetricPendulum, TaylorPendulum, Transverse, WholeTree,
};
pub use transfer_forms::{TransferForm, TransferForms};

#[cfg(feature = "macros")]
#[doc = include_str!("attribute.md")]
pub use branched_pendulum_macros::branched_pendulum;
