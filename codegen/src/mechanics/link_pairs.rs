//! Springs and friction between links that are not parent and child.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::joint::JointQuantity;
use super::meaning::{JointDifference, PairDifferences};
use crate::scene::{Coordinate, LinkId, LinkPair, PassiveTorques};

/// A spring and friction between two links, in the form that the articulated-body recursion and the
/// computation by means and differences use.
#[derive(Clone, Debug, PartialEq)]
pub struct PairElement<V = Expr> {
    /// The two links.
    pub pair: LinkPair,
    /// Relative angle minus rest angle, θ_a − θ_b − ρ; zero without a spring.
    pub strain: V,
    /// Relative rate ω_a − ω_b; zero without viscous friction.
    pub rate: V,
    /// Coefficients of spring and friction.
    pub passive: PassiveTorques<V>,
}

impl Derivation<'_> {
    /// Returns the difference of two links' angles or rates as a symbol.
    pub(super) fn pair_difference(
        &mut self,
        quantity: JointQuantity,
        pair: LinkPair,
        symbols: &[SymbolId],
        rest: Formula,
    ) -> Formula {
        let [LinkId(a), LinkId(b)] = pair.links;
        let difference = JointDifference::of_links(symbols[a], Some(symbols[b]), rest);
        let names = self.pair_names(pair);
        self.joint(quantity, &names, difference)
    }

    /// Returns the replacements for the differences of pairs in symmetric coordinates. Within the
    /// copies of one group they are sums of the copies' differences, written out so that terms can
    /// cancel.
    pub(super) fn symmetric_pairs(
        &mut self,
        coordinates: &[Coordinate],
        [angles, rates]: [&[SymbolId]; 2],
    ) -> Vec<(SymbolId, Formula)> {
        let mut replacements = Vec::new();
        for number in 0..self.pairs.len() {
            let PairDifferences { pair, angle, rate } = &self.pairs[number];
            let pair = *pair;
            let found = [
                (angle.clone(), JointQuantity::SymmetricPairAngle, angles),
                (rate.clone(), JointQuantity::SymmetricPairRate, rates),
            ];
            let weights = pair.weights(coordinates);
            let groups = weights.iter().map(|&(index, _)| {
                let (_, sector) = coordinates[index].kind.orbit_and_difference();
                sector.map(|(group, _)| group)
            });
            let groups: Vec<Option<usize>> = groups.collect();
            let is_of_one = groups
                .first()
                .is_some_and(|first| first.is_some() && groups.iter().all(|own| own == first));
            for (difference, quantity, symbols) in found {
                let symbol = difference.and_then(|own| own.symbols().into_iter().next());
                let Some((symbol, known)) =
                    symbol.and_then(|own| Some((own, self.joints.get(&own)?)))
                else {
                    continue;
                };
                let terms = weights.iter();
                let terms = terms.map(|&(index, weight)| (symbols[index], weight));
                let difference = JointDifference {
                    terms: terms.collect(),
                    rest: known.rest.clone(),
                };
                let formula = match is_of_one && difference.rest.is_zero() {
                    true => difference.written_out(),
                    false => {
                        let names = self.pair_names(pair);
                        self.joint(quantity, &names, difference)
                    }
                };
                replacements.push((symbol, formula));
            }
        }
        replacements
    }

    /// Returns true if a symbol is the difference of a pair of links.
    pub(super) fn is_of_pair(&self, symbol: SymbolId) -> bool {
        let mut differences = self.pairs.iter().flat_map(|own| [&own.angle, &own.rate]);
        differences.any(|own| {
            own.as_ref()
                .is_some_and(|own| own.symbols().contains(&symbol))
        })
    }

    /// Returns all pairs as plain data.
    pub(super) fn plain_pairs(&self) -> Vec<PairElement> {
        let difference = |own: &Option<Formula>| {
            own.as_ref()
                .map_or_else(Expr::zero, |formula| self.expr(formula))
        };
        let pairs = self.pairs.iter().map(|own| {
            let names = self.scene.spring_damper_names(own.pair.spring_damper);
            PairElement {
                pair: own.pair,
                strain: difference(&own.angle),
                rate: difference(&own.rate),
                passive: self.passive_constants(&names),
            }
        });
        pairs.collect()
    }
}
