//! Programs for trees with identical subtrees, formed on means and differences
//! of copies instead of on single links.
//!
//! A quantity that every link of an orbit has is one
//! [`Field`](field::Field): its mean and its Helmert differences. Sums,
//! products, quotients, sine and cosine of fields are formed without ever
//! subtracting copies, so what is exactly zero stays so and what is small keeps
//! its digits; with values graded by powers of ε
//! ([`Graded`](series::Graded)) the same formulas give the expansion about the
//! in-phase motion to any order.

mod budget;
mod field;
mod motion;
mod named;
mod parseval;
mod potential;
mod reciprocal;
mod sector;
mod series;
mod solve;
mod tree;
mod turn;

pub(super) use budget::{Motion, Share};
pub(super) use field::{Copies, Field};
pub(super) use motion::{CouplingValues, Fields, OrbitValues, Pose, Values};
pub(super) use sector::Which;
pub(super) use series::{Graded, Series};
pub(super) use solve::Factors;
pub(super) use tree::{Orbit, orbits};
