//! Order conditions of a Runge–Kutta table, for the tests of the tables.
//!
//! There is one condition for each rooted tree t: Σ_i b_i Φ_i(t) = 1/γ(t); for dense output Σ_i
//! b_i(s) Φ_i(t) = s^order/γ(t). Hairer, Nørsett, Wanner, *Solving ODEs I*, section II.2.

use std::vec::Vec;

use super::pair::EmbeddedPair;

/// Nodes and rows of a Runge–Kutta table, by stage.
pub(super) struct ButcherTable {
    pub(super) nodes: Vec<f64>,
    pub(super) rows: Vec<&'static [(usize, f64)]>,
}

impl ButcherTable {
    /// Returns the table of a pair.
    pub(super) fn of<M: EmbeddedPair>() -> Self {
        let rows = M::ROWS.iter().copied();
        Self {
            nodes: M::NODES.to_vec(),
            rows: core::iter::once(&[][..]).chain(rows).collect(),
        }
    }

    pub(super) fn assert_row_sums(&self) {
        for (row, node) in self.rows.iter().zip(&self.nodes) {
            let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
            let size: f64 = row.iter().map(|(_, weight)| weight.abs()).sum();
            assert!(
                (sum - node).abs() <= 16.0 * f64::EPSILON * size.max(1.0),
                "{sum} is not {node}"
            );
        }
    }
}

/// A rooted tree: its order, its density γ, its branches (as indices of trees), and the elementary
/// weight Φ_i of each stage i, with a bound on its size.
pub(super) struct RootedTree {
    order: u32,
    density: f64,
    branches: Vec<usize>,
    stages: Vec<(f64, f64)>,
}

/// Returns all rooted trees up to order `highest`, with the elementary weights Φ_i of the stages of
/// `table`.
pub(super) fn stage_values(table: &ButcherTable, highest: u32) -> Vec<RootedTree> {
    let count = table.nodes.len();
    let mut trees = std::vec![RootedTree {
        order: 1,
        density: 1.0,
        branches: Vec::new(),
        stages: std::vec![(1.0, 1.0); count],
    }];
    for order in 2..=highest {
        let mut found = Vec::new();
        collect(&trees, order - 1, trees.len(), &mut Vec::new(), &mut found);
        for branches in found {
            let density: f64 = branches.iter().map(|&t| trees[t].density).product();
            let stages = (0..count).map(|i| {
                branches.iter().fold((1.0, 1.0), |product, &branch| {
                    let (sum, size) = sums(table.rows[i], &trees[branch].stages);
                    (product.0 * sum, product.1 * size)
                })
            });
            let stages = stages.collect();
            trees.push(RootedTree {
                order,
                density: density * f64::from(order),
                branches,
                stages,
            });
        }
    }
    trees
}

/// Appends all multisets of trees whose index is below `bound` and whose orders add up to `left`.
fn collect(
    trees: &[RootedTree],
    left: u32,
    bound: usize,
    chosen: &mut Vec<usize>,
    found: &mut Vec<Vec<usize>>,
) {
    if left == 0 {
        found.push(chosen.clone());
    }
    for (index, tree) in trees.iter().enumerate().take(bound) {
        if tree.order <= left {
            chosen.push(index);
            collect(trees, left - tree.order, index + 1, chosen, found);
            chosen.pop();
        }
    }
}

fn sums(row: &[(usize, f64)], values: &[(f64, f64)]) -> (f64, f64) {
    row.iter()
        .fold((0.0, 0.0), |(sum, size), &(stage, weight)| {
            let (value, bound) = values[stage - 1];
            (sum + weight * value, size + weight.abs() * bound)
        })
}

/// Returns the order of the formula with these weights; at most the highest order of the given
/// trees.
pub(super) fn order(trees: &[RootedTree], weights: &[(usize, f64)]) -> u32 {
    let missed = trees.iter().find(|tree| {
        let (sum, size) = sums(weights, &tree.stages);
        (sum - 1.0 / tree.density).abs() > 8.0 * f64::EPSILON * size.max(1.0)
    });
    let highest = trees.last().map_or(0, |tree| tree.order);
    missed.map_or(highest, |tree| tree.order - 1)
}

/// Weights of all stages at one fraction of the step, each with the sum of the magnitudes of its
/// terms.
pub(super) struct StageWeights(Vec<(f64, f64)>);

impl StageWeights {
    pub(super) fn add(&mut self, stage: usize, value: f64) {
        self.0[stage - 1].0 += value;
        self.0[stage - 1].1 += value.abs();
    }
}

/// Asserts that the dense output with the weights of `fill(s, weights)` has the order `order` at
/// every fraction s of the step.
pub(super) fn continuous(trees: &[RootedTree], order: u32, fill: impl Fn(f64, &mut StageWeights)) {
    for s in [0.1_f64, 0.3, 0.5, 0.7, 0.9, 1.0] {
        for tree in trees.iter().filter(|tree| tree.order <= order) {
            let mut weights = StageWeights(std::vec![(0.0, 0.0); tree.stages.len()]);
            fill(s, &mut weights);
            let both = weights.0.iter().zip(&tree.stages);
            let (sum, size) = both.fold((0.0, 0.0), |(sum, size), (weight, stage)| {
                (sum + weight.0 * stage.0, size + weight.1 * stage.1)
            });
            let expected = s.powi(i32::try_from(tree.order).unwrap()) / tree.density;
            assert!(
                (sum - expected).abs() <= 8.0 * f64::EPSILON * size.max(1.0),
                "{:?} at {s}: {sum} is not {expected}",
                tree.branches
            );
        }
    }
}

#[test]
fn the_numbers_of_trees_are_known() {
    let table = ButcherTable {
        nodes: Vec::new(),
        rows: Vec::new(),
    };
    let trees = stage_values(&table, 9);
    let counts = (1..=9).map(|order| trees.iter().filter(|t| t.order == order).count());
    assert_eq!(
        counts.collect::<Vec<_>>(),
        [1, 1, 2, 4, 9, 20, 48, 115, 286]
    );
    let densities: f64 = trees
        .iter()
        .filter(|t| t.order == 4)
        .map(|t| t.density)
        .sum();
    assert_eq!(densities, 4.0 + 8.0 + 12.0 + 24.0);
}
