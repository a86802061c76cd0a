//! Programs for trees with identical subtrees, formed on means and differences
//! of copies instead of on single links.
//!
//! A quantity that every link of an orbit has is one
//! [`SymmetricField`](field::SymmetricField): its mean and its Helmert differences. Sums,
//! products, quotients, sine and cosine of fields are formed without ever
//! subtracting copies, so what is exactly zero stays so and what is small keeps
//! its digits; with values graded by powers of ε
//! ([`SeriesArithmetic`](series::SeriesArithmetic)) the same formulas give the expansion about the
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
