//! Linear systems with a symmetric positive definite matrix, written out by elimination from the
//! last unknown to the first: M = Lᵀ D L (Featherstone, Rigid Body Dynamics Algorithms, 2008,
//! §6.5). On a tree whose parents come before their children there is no fill-in; for other
//! matrices fill-in is included.

use super::ValueId;
use super::builder::Builder;
use std::collections::BTreeMap;

/// Lower triangle of a sparse symmetric matrix of values.
pub(super) type Matrix = BTreeMap<(usize, usize), ValueId>;

impl Builder {
    /// Solves M x = b for x. `names` are the names of the unknowns; the reduced inertias d and the
    /// multipliers l of the elimination are named after them.
    pub(super) fn solve(
        &mut self,
        mut matrix: Matrix,
        mut right: Vec<ValueId>,
        names: &[String],
    ) -> Vec<ValueId> {
        let n = right.len();
        let one = self.integer(1);
        let mut multipliers: Matrix = BTreeMap::new();
        for k in (0..n).rev() {
            let reduced = match matrix.get(&(k, k)) {
                Some(&value) => self.name(value, &format!("reduced_inertia_{}", names[k])),
                None => unreachable!("no diagonal entry {k} in a positive definite matrix"),
            };
            let inverse = self.div(one, reduced);
            self.name(inverse, &format!("inverse_reduced_inertia_{}", names[k]));
            let row: Vec<(usize, ValueId)> = (0..k)
                .filter_map(|i| matrix.get(&(k, i)).map(|&value| (i, value)))
                .collect();
            for &(i, value) in &row {
                // l_ki = M_ki / d_k
                let l = self.mul(value, inverse);
                self.name(l, &format!("ratio_{}_{}", names[k], names[i]));
                multipliers.insert((k, i), l);
                // M_ij ← M_ij − l_ki M_kj
                for &(j, other) in row.iter().filter(|(j, _)| *j <= i) {
                    let product = self.mul(l, other);
                    let old = matrix.get(&(i, j)).copied();
                    let new = match old {
                        Some(old) => self.sub(old, product),
                        None => self.neg(product),
                    };
                    matrix.insert((i, j), new);
                }
                // b_i ← b_i − l_ki b_k
                let product = self.mul(l, right[k]);
                right[i] = self.sub(right[i], product);
            }
            right[k] = self.mul(right[k], inverse);
        }
        // x_k = b_k/d_k − Σ_i l_ki x_i, from the root outwards.
        for k in 0..n {
            for i in 0..k {
                if let Some(&l) = multipliers.get(&(k, i)) {
                    let product = self.mul(l, right[i]);
                    right[k] = self.sub(right[k], product);
                }
            }
        }
        right
    }
}
