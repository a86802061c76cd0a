//! The mechanics: what is derived and emitted, against independent derivations,
//! reference numbers and the paper's formulas.

mod random_trees;
mod support;
