//! Pendulum trees that are described while a program runs.
//!
//! The attribute `branched_pendulum` derives the equations of one tree when a program is compiled.
//! [`PendulumTree::parse`] instead creates a tree at run time, from a text in the grammar of the
//! attribute, without a compiler and without Symbolica. It uses equations that the compiler has
//! derived for one link with arbitrary properties; they are part of this crate, and the runtime
//! evaluates them along any tree.
//!
//! A tree is a [`Model`](branched_pendulum::Model), and has the traits that compiled models have:
//! accelerations, energies, positions, forces, torques from outside, links that are held, canonical
//! variables, drives, Taylor series, every integrator, batches, ensembles in lanes, derivatives in
//! reverse mode ([`PendulumTree::pullback`]). Momenta, linear
//! modes, observables and, of trees by rule, budgets by scale are there too; of trees with copies
//! symmetric coordinates and the energy transfer W in all its forms ([`PendulumTree::symmetric`]).
//! The speed of code that is written out stays with compiled models: `docs/run-time-trees.md`.

mod between;
mod canonical;
mod carried;
mod description;
#[cfg(feature = "identification")]
mod design;
mod drive;
mod energies;
mod equations;
mod error;
#[cfg(feature = "strips")]
mod evaluator;
#[cfg(not(feature = "strips"))]
#[path = "evaluator_by_link.rs"]
mod evaluator;
#[cfg(feature = "identification")]
mod family;
mod forms;
mod in_phase;
mod line_points;
mod lineage;
mod model;
mod normal_form;
mod numbers;
mod observables;
mod parametric;
#[cfg(feature = "strips")]
mod prescribed;
mod pullback;
mod rows;
mod scales;
mod series;
mod signal_series;
mod stiffness;
mod symmetric;
mod text;
mod thermal;
mod tree;

pub use branched_pendulum_codegen::scene::{Lineage, strength_unit};
pub use description::TreeDescription;
#[cfg(feature = "identification")]
pub use design::{DesignSettings, QuantityValue, TreeDesign, TreeQuantity};
pub use error::{DescriptionError, Mistake, TreeError};
pub use in_phase::{DifferenceGrowth, InPhaseTree};
pub use line_points::LinePoint;
pub use normal_form::TreeNormalForm;
pub use observables::Observable;
pub use parametric::{DescribedNode, EquationsOfMotion, ParameterUse};
pub use pullback::{AccelerationSlopes, TreePullback};
pub use tree::PendulumTree;
