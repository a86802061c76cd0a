//! The factor that is taken out of a sum of products, and the terms that stand
//! then.

use crate::program::ValueId;
use crate::program::builder::Builder;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// A product with its sign, in values of the program in the making.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Term {
    pub(super) negative: bool,
    pub(super) factors: Vec<ValueId>,
    /// The value that it has already, if nothing is taken out of it.
    pub(super) value: Option<ValueId>,
}

impl Term {
    fn value(&self, builder: &mut Builder) -> ValueId {
        self.value
            .unwrap_or_else(|| product(builder, &self.factors))
    }
}

/// Takes factors out, greatest saving first; says what is saved.
pub(super) fn extract(builder: &mut Builder, terms: &mut Vec<Term>, fused: bool) -> usize {
    let mut saved = 0;
    while let Some((factor, gain)) = best(terms, fused) {
        saved += gain;
        let first = terms.iter().position(|term| term.factors.contains(&factor));
        let mut group = Vec::new();
        terms.retain_mut(|term| {
            let place = term.factors.iter().position(|&f| f == factor);
            match place {
                Some(place) if term.factors.len() > 1 => {
                    term.factors.remove(place);
                    term.value = None;
                    group.push(term.clone());
                    false
                }
                _ => true,
            }
        });
        let negative = group.iter().all(|term| term.negative);
        for term in &mut group {
            term.negative ^= negative;
        }
        saved += extract(builder, &mut group, fused);
        let cofactor = sum(builder, &group);
        let place = first.unwrap_or(0).min(terms.len());
        let term = Term {
            negative,
            factors: vec![factor, cofactor],
            value: None,
        };
        terms.insert(place, term);
    }
    saved
}

/// A sum's value; it starts with a positive term if it has one.
pub(super) fn sum(builder: &mut Builder, terms: &[Term]) -> ValueId {
    let first = terms.iter().position(|term| !term.negative).unwrap_or(0);
    let negative = terms[first].negative;
    let mut sum = terms[first].value(builder);
    for (index, term) in terms.iter().enumerate() {
        if index != first {
            let value = term.value(builder);
            sum = match term.negative == negative {
                true => builder.add(sum, value),
                false => builder.sub(sum, value),
            };
        }
    }
    if negative { builder.neg(sum) } else { sum }
}

/// A product's value: constants last, so that what they multiply is shared.
pub(super) fn product(builder: &mut Builder, factors: &[ValueId]) -> ValueId {
    let (constants, values): (Vec<ValueId>, Vec<ValueId>) = factors
        .iter()
        .partition(|&&factor| builder.is_constant(factor));
    let mut factors = values.into_iter().chain(constants);
    let Some(first) = factors.next() else {
        return builder.integer(1);
    };
    factors.fold(first, |product, factor| builder.mul(product, factor))
}

/// The factor that saves most, and what it saves.
fn best(terms: &[Term], fused: bool) -> Option<(ValueId, usize)> {
    let mut gains: BTreeMap<ValueId, (isize, Reverse<usize>)> = BTreeMap::new();
    for term in terms.iter().filter(|term| term.factors.len() > 1) {
        let mut seen: Vec<ValueId> = Vec::new();
        for &factor in &term.factors {
            if !seen.contains(&factor) {
                seen.push(factor);
                // Fused, a product of two costs nothing in its sum.
                let saving = isize::from(!fused || term.factors.len() > 2);
                let place = Reverse(gains.len());
                gains.entry(factor).or_insert((-1, place)).0 += saving;
            }
        }
    }
    let (factor, (gain, _)) = gains.into_iter().max_by_key(|&(_, gain)| gain)?;
    (gain > 0).then_some((factor, gain as usize))
}
