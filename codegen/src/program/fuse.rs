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

#[cfg(test)]
mod tests {
    use crate::functions::{Argument, Purpose};
    use crate::program::ValueId;
    use crate::program::builder::Builder;

    fn inputs(builder: &mut Builder) -> [ValueId; 4] {
        std::array::from_fn(|index| builder.input(Argument::Theta, index))
    }

    #[test]
    fn products_in_sums_alone_are_fused() {
        let mut builder = Builder::default();
        let [a, b, c, d] = inputs(&mut builder);
        let (ab, cd) = (builder.mul(a, b), builder.mul(c, d));
        let sum = builder.add(ab, cd);
        let minus = builder.sub(c, ab);
        let program = builder
            .clone()
            .program(Purpose::Accelerations, vec![sum, minus]);
        let fused = program.fused(&program.entries[0]);
        // The second of two products in a sum; the first is computed separately for both.
        assert_eq!(fused[&sum].product, cd);
        assert!(!fused.contains_key(&minus));
        let program = builder.program(Purpose::Accelerations, vec![minus]);
        let fused = program.fused(&program.entries[0]);
        assert!(fused[&minus].product == ab && fused[&minus].minus_product);
    }

    #[test]
    fn differences_of_products_and_other_functions_are_not() {
        let mut builder = Builder::default();
        let [a, b, c, d] = inputs(&mut builder);
        let (ab, cd) = (builder.mul(a, b), builder.mul(c, d));
        let (difference, sum) = (builder.sub(ab, cd), builder.add(ab, cd));
        let program = builder
            .clone()
            .program(Purpose::Accelerations, vec![difference]);
        assert!(program.fused(&program.entries[0]).is_empty());
        let program = builder.program(Purpose::KineticEnergy, vec![sum]);
        assert!(program.fused(&program.entries[0]).is_empty());
    }
}
