//! The fusion of products with the sums that they feed.
//!
//! # Rule
//! A product that sums alone use, each of them formed anew from it, is part of
//! these sums: x y + z, x y − z or z − x y, rounded once where the scalar fuses,
//! and twice, as if it stood alone, where it does not. Of two such products in
//! one sum the second is taken.
//!
//! A difference of two products is never fused. It is zero where the products
//! are equal: that sin θ_i cos θ_j − cos θ_i sin θ_j vanishes for equal angles
//! keeps motions in phase for ever.

use crate::functions::Purpose;

use super::{Entry, Op, Pass, Program, ValueId};
use std::collections::{BTreeMap, BTreeSet};

/// A sum with a product in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FusedSum {
    /// The product.
    pub product: ValueId,
    /// True if the product is subtracted.
    pub minus_product: bool,
    /// The value to which the product is added.
    pub addend: ValueId,
    /// True if the addend is subtracted.
    pub minus_addend: bool,
}

impl Program {
    /// The fused sums of an entry point, which are those of accelerations, with those of small
    /// differences or without, and of links in loops: other
    /// functions run in plain numbers. Linear in the program's length, times a
    /// logarithm.
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
        // Products that something else than a sum needs.
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

    /// The fused sums, if the products in `kept` are formed alone.
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
        // Of two products in a sum the second; the first is formed for both.
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
