//! Rules that make an operation simpler at the moment at which it is formed.
//!
//! A rule is one function in a file of its own: it is shown an operation whose
//! operands are formed already, and gives the value that the operation becomes,
//! or nothing where it does not apply. [`RULES`] are tried in their order; what none of
//! them changes is recorded, where an equal operation is found first
//! ([`sharing`]). Each looks at one operation and the definitions of its operands, so
//! that a program of n operations costs O(n log n) in all: the logarithm is that
//! of the table of operations.

mod folding;
mod neutral;
pub(super) mod sharing;
mod signs;

use super::Builder;
use crate::program::{Op, Pass, ValueId};

/// The value that an operation becomes, if the rule applies.
type Rule = fn(&mut Builder, &Op) -> Option<ValueId>;

/// The rules in the order in which they are tried, and the passes that they are.
/// The first is always on: what symmetry makes zero is to vanish from every program.
pub(super) const RULES: [(Option<Pass>, Rule); 3] = [
    (None, neutral::neutral),
    (Some(Pass::Signs), signs::signs),
    (Some(Pass::Folding), folding::folding),
];
