//! Rules that simplify an operation before it is added to the program.
//!
//! Each rule is one function in its own file. It gets an operation whose operands exist already,
//! and returns the value that replaces it, or `None` if the rule does not apply. [`RULES`] are
//! tried in order. An operation that none of them changes is recorded, unless an equal operation
//! exists already ([`sharing`]). Each rule inspects only the operation and the definitions of its
//! operands. A program of n operations therefore costs O(n log n), where the logarithm is that of
//! the table of operations.

mod folding;
mod neutral;
pub(super) mod sharing;
mod signs;

use super::Builder;
use crate::program::{Op, Pass, ValueId};

/// A rule. Returns the replacement of an operation, or `None` if the rule does not apply.
type Rule = fn(&mut Builder, &Op) -> Option<ValueId>;

/// The rules in the order in which they are tried, each with its pass. The first rule is always
/// active, because terms that are zero by symmetry must vanish from every program.
pub(super) const RULES: [(Option<Pass>, Rule); 3] = [
    (None, neutral::neutral),
    (Some(Pass::Signs), signs::signs),
    (Some(Pass::Folding), folding::folding),
];
