//! Fusion of products with the sums that use them.
//!
//! # Rule
//! If all uses of a product are sums, it becomes a part of these sums: x y + z, x y − z or z − x y.
//! The result is rounded once if the scalar type supports fused operations, and twice otherwise, as
//! for a separate product. If a sum has two such products, the second is fused.
//!
//! A difference of two products is never fused, so that it is exactly zero if the products are
//! equal. Because sin θ_i cos θ_j − cos θ_i sin θ_j vanishes for equal angles, in-phase motions
//! stay in phase.

use crate::functions::Purpose;

use super::{Entry, Op, Pass, Program, ValueId};
use std::collections::{BTreeMap, BTreeSet};

/// A sum that contains a fused product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FusedSum {
    /// The product that is fused with an addition.
    pub product: ValueId,
    /// True if the product is subtracted.
    pub minus_product: bool,
    /// The value to which the product is added.
    pub addend: ValueId,
    /// True if the addend is subtracted.
    pub minus_addend: bool,
}

impl Program {
    /// Returns the fused sums of an entry point. Operations are fused in accelerations (also in
    /// those of small differences) and in functions of links in loops; other functions use plain
    /// sums. Linear in the program's length, times a logarithm.
    pub fn fused(&self, entry: &Entry) -> BTreeMap<ValueId, FusedSum> {
        let accelerates = matches!(
            entry.purpose,
            Purpose::Accelerations
                | Purpose::TransverseMotion(_)
                | Purpose::Link(_)
                | Purpose::Scale(_)
        );
        if !accelerates || self.without == Some(Pass::Fusing) {
            return BTreeMap::new();
        }
        let needed = self.needed(&entry.outputs);
        // Products that are used by other operations than sums.
        let mut kept: BTreeSet<ValueId> = entry.outputs.iter().copied().collect();
        let mut sums = self.sums(&needed, &kept);
        loop {
            let taken: BTreeMap<ValueId, ValueId> = sums
                .iter()
                .map(|(sum, fused)| (*sum, fused.product))
                .collect();
            let before = kept.len();
            for &id in &needed {
                for operand in self.definition(id).op.operands() {
                    if self.is_product(operand) && taken.get(&id) != Some(&operand) {
                        kept.insert(operand);
                    }
                }
            }
            if kept.len() == before {
                return sums;
            }
            sums = self.sums(&needed, &kept);
        }
    }

    fn is_product(&self, id: ValueId) -> bool {
        matches!(self.definition(id).op, Op::Mul(..))
    }

    /// Returns the fused sums; the products in `kept` are computed separately.
    fn sums(&self, needed: &[ValueId], kept: &BTreeSet<ValueId>) -> BTreeMap<ValueId, FusedSum> {
        let free = |id: ValueId| self.is_product(id) && !kept.contains(&id);
        let fused = |id: ValueId| {
            let (a, b, minus) = match self.definition(id).op {
                Op::Add(a, b) => (a, b, false),
                Op::Sub(a, b) if !(self.is_product(a) && self.is_product(b)) => (a, b, true),
                _ => return None,
            };
            if a == b {
                None
            } else if free(b) {
                Some(FusedSum {
                    product: b,
                    minus_product: minus,
                    addend: a,
                    minus_addend: false,
                })
            } else if free(a) {
                Some(FusedSum {
                    product: a,
                    minus_product: false,
                    addend: b,
                    minus_addend: minus,
                })
            } else {
                None
            }
        };
        needed
            .iter()
            .filter_map(|&id| Some((id, fused(id)?)))
            .collect()
    }
}
