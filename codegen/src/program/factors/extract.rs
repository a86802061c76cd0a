//! Extraction of common factors from a sum of products.

use crate::program::builder::Builder;
use crate::program::{ConstantId, Op, ValueId};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// A product with its sign, in values of the program under construction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Term {
    pub(super) negative: bool,
    pub(super) factors: Vec<ValueId>,
    /// Existing value of the product, if no factor has been extracted from it.
    pub(super) value: Option<ValueId>,
}

impl Term {
    fn value(&self, builder: &mut Builder) -> ValueId {
        self.value
            .unwrap_or_else(|| product(builder, &self.factors))
    }
}

/// Extracts factors, the one with the greatest saving first; returns the number of saved
/// operations.
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
    share_constants(builder, terms);
    saved
}

/// Rewrites 4 c x + 2 c y as 2 c (2 x + y), which has as many operations. The model then has one
/// constant less, if 4 c is used nowhere else.
fn share_constants(builder: &mut Builder, terms: &mut Vec<Term>) {
    let mut first = 0;
    while first < terms.len() {
        let partner = (first + 1..terms.len()).find_map(|second| {
            let [a, b] = [first, second].map(|index| constant_factor(builder, &terms[index]));
            let ((place, a), (other, b)) = (a?, b?);
            let exponent = builder.setup.binary_exponent(a, b)?;
            (exponent != 0).then_some((second, [place, other], exponent))
        });
        let Some((second, places, exponent)) = partner else {
            first += 1;
            continue;
        };
        let other = terms.remove(second);
        let mut both = [terms.remove(first), other];
        let mut constants = [0, 1].map(|index| both[index].factors.remove(places[index]));
        // The smaller constant becomes the factor of the sum.
        if exponent > 0 {
            constants.swap(0, 1);
        }
        let larger = usize::from(exponent < 0);
        let power = builder.integer(1 << exponent.unsigned_abs());
        both[larger].factors.push(power);
        for term in &mut both {
            term.value = None;
        }
        let negative = both.iter().all(|term| term.negative);
        for term in &mut both {
            term.negative ^= negative;
        }
        let term = Term {
            negative,
            factors: vec![constants[0], sum(builder, &both)],
            value: None,
        };
        terms.insert(first, term);
    }
}

/// Returns the position of the only constant of the model in a term with several factors.
fn constant_factor(builder: &Builder, term: &Term) -> Option<(usize, ConstantId)> {
    let constant = |&id: &ValueId| match builder.op(id) {
        Op::Constant(id) => Some(*id),
        _ => None,
    };
    let place = term.factors.iter().position(|id| constant(id).is_some())?;
    let own = constant(&term.factors[place])?;
    (term.factors.len() > 1).then_some((place, own))
}

/// Builds a sum; it starts with a positive term if it has one.
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

/// Builds a product. Constants come last, so that the product of the other factors can be shared.
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

/// Returns the factor whose extraction saves most operations, and the number of these.
fn best(terms: &[Term], fused: bool) -> Option<(ValueId, usize)> {
    let mut gains: BTreeMap<ValueId, (isize, Reverse<usize>)> = BTreeMap::new();
    for term in terms.iter().filter(|term| term.factors.len() > 1) {
        let mut seen: Vec<ValueId> = Vec::new();
        for &factor in &term.factors {
            if !seen.contains(&factor) {
                seen.push(factor);
                // With fusing, a product of two factors costs nothing within a sum.
                let saving = isize::from(!fused || term.factors.len() > 2);
                let place = Reverse(gains.len());
                gains.entry(factor).or_insert((-1, place)).0 += saving;
            }
        }
    }
    let (factor, (gain, _)) = gains.into_iter().max_by_key(|&(_, gain)| gain)?;
    (gain > 0).then_some((factor, gain as usize))
}
