//! Parts of emitted recurrences of Taylor coefficients.
//!
//! [`expand`] has the recurrences of a tree: emitted code hands it the
//! constants of its equation of motion. What else moves the tree, functions of
//! the time and torques of friction and springs, emitted code computes order by
//! order, with [`sums`] for its products of series.
//!
//! [`SeriesTree`] has the same for trees whose number of links no type tells.
//!
//! [`integrate::Taylor`] is the method that uses both.
//!
//! [`integrate::Taylor`]: crate::integrate::Taylor

mod bias;
mod eliminated_link;
mod elimination;
mod expand;
mod friction;
mod lent;
mod lines;
mod links;
mod orders;
mod reciprocal;
mod recurrence;
mod refine;
mod room;
mod series;
mod start;
mod sums;
#[cfg(test)]
mod tests;
mod torques;
mod tree;
mod tree_expansion;

pub use crate::simd::Quad;
pub use bias::KnownOrder;
pub use expand::{expand, workspace};
pub use friction::RoughFriction;
pub use links::Connectivity;
pub use start::{LinkConstants, Start};
pub use sums::{Factors, rows, sums, whole};
pub use tree::{SeriesForm, SeriesLink, SeriesTree};
