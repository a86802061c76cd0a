//! Programs for trees with identical subtrees, computed on means and differences of copies instead
//! of on single links.
//!
//! A quantity of all links of an orbit (equal copies of one link) is one
//! [`SymmetricField`](field::SymmetricField): its mean and its Helmert differences. Sums, products,
//! quotients, sines and cosines of fields are computed without subtracting copies, so that zero
//! differences remain zero and small ones keep their digits. With values graded by powers of ε
//! ([`SeriesArithmetic`](series::SeriesArithmetic)), the same formulas give the expansion about the
//! in-phase motion to any order.

mod budget;
mod chords;
mod direction;
mod field;
mod friction;
mod motion;
mod named;
mod pairs;
mod parseval;
mod potential;
mod reciprocal;
mod sector;
mod series;
mod solve;
mod spring_dampers;
mod tree;

pub(super) use budget::{Share, SymmetricMotion};
pub(super) use field::{SymmetricField, SymmetricTree};
pub(super) use friction::LawValues;
pub(super) use motion::{ConstantValues, Fields, OrbitValues, Pose};
pub(super) use series::{SeriesArithmetic, TruncatedSeries};
pub(super) use solve::MassFactors;
pub(super) use spring_dampers::SpringDamperValues;
pub(super) use tree::{OrbitLinks, SectorId, orbits};
