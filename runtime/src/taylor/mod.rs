//! Taylor coefficients of the motion of a tree, for emitted code.
//!
//! [`expand`] computes the recurrences of a tree; emitted code passes the constants of the tree's
//! equation of motion to it. Other torques, which depend on time or come from friction and springs,
//! are computed by emitted code order by order, with [`sums`] for products of series.
//!
//! [`SeriesTree`] does the same for trees whose number of links is not a compile-time constant.
//!
//! [`integrate::Taylor`] is the method that uses both.
//!
//! [`integrate::Taylor`]: crate::integrate::Taylor

mod bias;
mod buffer;
mod caller_buffers;
mod eliminated_link;
mod elimination;
mod expand;
mod friction;
mod lines;
mod links;
mod orders;
mod reciprocal;
mod recurrence;
mod refine;
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
pub use friction::NonViscousFriction;
pub use links::Connectivity;
pub use start::{LinkConstants, Start};
pub use sums::{Factors, rows, sums, whole};
pub use tree::{SeriesForm, SeriesLink, SeriesTree};
