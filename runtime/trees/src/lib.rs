//! Pendulum trees that are described while a program runs.
//!
//! The attribute `branched_pendulum` derives the equations of one tree when a program is
//! compiled. Here a text in the attribute's own grammar becomes a tree at once, without a
//! compiler and without Symbolica: [`PendulumTree::parse`]. The equations are those that
//! the compiler derived and wrote for one link with all its properties left open; they are
//! part of this crate, and the runtime takes them through any tree.
//!
//! A tree is a [`Model`](branched_pendulum::Model), and has the traits that compiled models have:
//! accelerations, energies, positions, forces, torques from outside, links that are held, canonical
//! variables, drives, Taylor series, every integrator, batches, ensembles in lanes. Momenta, linear
//! modes and, of trees by rule, budgets by scale are there too. Other energy transfers, symmetric
//! coordinates and observables are derived for one tree and stay with compiled models, as does
//! the speed of code that is written out: `docs/run-time-trees.md`.

mod canonical;
mod description;
mod drive;
mod energies;
mod equations;
mod error;
mod forms;
mod model;
mod numbers;
#[cfg(feature = "strips")]
mod prescribed;
mod rows;
mod scales;
mod series;
mod signal_series;
mod text;
mod tree;
#[cfg(feature = "strips")]
mod ways;
#[cfg(not(feature = "strips"))]
#[path = "ways_by_link.rs"]
mod ways;

pub use description::TreeDescription;
pub use error::{DescriptionError, Mistake, TreeError};
pub use tree::PendulumTree;
