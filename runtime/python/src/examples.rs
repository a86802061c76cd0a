//! Texts of the example trees, which the command-line program ships too.

use pyo3::prelude::*;

/// Names and texts.
const TREES: [(&str, &str); 8] = [
    ("PAPER", include_str!("trees/paper.txt")),
    ("APPARATUS", include_str!("trees/apparatus.txt")),
    ("DOUBLE_PENDULUM", include_str!("trees/double-pendulum.txt")),
    ("CHAIN", include_str!("trees/chain.txt")),
    ("TRIPLE", include_str!("trees/triple.txt")),
    ("Y", include_str!("trees/y.txt")),
    ("CASCADE", include_str!("trees/cascade.txt")),
    ("BRANCH", include_str!("trees/branch.txt")),
];

/// Returns the names and texts of the example trees.
#[pyfunction]
pub(crate) fn example_texts() -> Vec<(&'static str, &'static str)> {
    TREES.to_vec()
}
