//! Equations of small differences between copies: those along a motion in phase, and those
//! that act back on it.

use super::MatrixEntry;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::frame::DerivedFrame;
use crate::scene::TransverseCopies;
use std::collections::BTreeMap;
use std::ops::Range;

/// The equations of one sector: M δ̈ + residual = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseFormulas {
    /// Links of the sector.
    pub sector: TransverseCopies,
    /// Differences of its links.
    pub differences: Vec<SymbolId>,
    /// Their rates.
    pub rates: Vec<SymbolId>,
    /// The sector's block of the mass matrix, lower triangle; of one holder's copies.
    pub mass: Vec<MatrixEntry>,
    /// Terms linear in the differences and their rates, friction and drag included.
    pub residual: Vec<Expr>,
    /// Energy of the differences in one holder's copies.
    pub energy: Expr,
    /// Rate of the energy without friction and drag.
    pub transfer: Expr,
    /// The power of friction and drag on it; zero without both.
    pub friction: Expr,
    /// True if that power depends on the in-phase motion, as it does where friction is not
    /// viscous.
    pub braked: bool,
}

/// All sectors, with the accelerations of the in-phase motion that drive them.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseMechanics {
    /// Accelerations of the scene's links.
    pub accelerations: Vec<SymbolId>,
    /// The sectors.
    pub sectors: Vec<TransverseFormulas>,
    /// Small differences that act back, if any are asked for.
    pub small: Option<SmallMechanics>,
}

/// Symbols of the small motion of all links beside the in-phase one.
pub(super) struct SmallMotion {
    pub(super) accelerations: Vec<SymbolId>,
    pub(super) differences: Vec<SymbolId>,
    pub(super) rates: Vec<SymbolId>,
    /// Angles and rates of joints by their symbols: the link, and by how much they change
    /// where the parent does not change and where it does.
    pub(super) joints: BTreeMap<SymbolId, (usize, [Formula; 2])>,
    /// Differences of copies from their mean, zero in phase, by their symbols: the link that
    /// stands for the copies, and the change.
    pub(super) copies: BTreeMap<SymbolId, (usize, Formula)>,
}

impl SmallMotion {
    pub(super) fn difference(&self, link: usize) -> Formula {
        Formula::symbol(self.differences[link])
    }

    pub(super) fn rate(&self, link: usize) -> Formula {
        Formula::symbol(self.rates[link])
    }

    /// A formula of the motion in phase.
    pub(super) fn in_phase(&self, formula: &Formula) -> Formula {
        let zeros = self
            .copies
            .keys()
            .map(|&symbol| (symbol, Formula::zero()))
            .collect::<Vec<_>>();
        formula.substitute(&zeros)
    }

    /// By how much an angle or a rate, of a link or of a joint, changes where these links move;
    /// none where the symbol is no such thing.
    pub(super) fn change(
        &self,
        derivation: &Derivation<'_>,
        frame: &DerivedFrame,
        symbol: SymbolId,
        block: &Range<usize>,
    ) -> Option<Formula> {
        if let Some((link, [alone, relative])) = self.joints.get(&symbol) {
            let parent = derivation.scene.links[*link].parent.map(|parent| parent.0);
            let holder = parent.filter(|parent| block.contains(parent));
            return Some(match (block.contains(link), holder) {
                (true, Some(_)) => relative.clone(),
                (true, None) => alone.clone(),
                (false, _) => Formula::zero(),
            });
        }
        if let Some((link, change)) = self.copies.get(&symbol) {
            // Only between these copies themselves there is a difference.
            return Some(match block.start == *link {
                true => change.clone(),
                false => Formula::zero(),
            });
        }
        if let Some(pair) = derivation.joints.get(&symbol) {
            let terms = pair.terms.iter().filter_map(|&(own, weight)| {
                let change = self.change(derivation, frame, own, block)?;
                Some(&Formula::integer(weight) * &change)
            });
            return Some(terms.sum());
        }
        let of = |symbols: &[SymbolId], changes: &[SymbolId]| {
            let link = symbols.iter().position(|own| *own == symbol)?;
            let moves = block.contains(&link);
            Some(if moves {
                Formula::symbol(changes[link])
            } else {
                Formula::zero()
            })
        };
        of(&frame.coordinates, &self.differences).or_else(|| of(&frame.velocities, &self.rates))
    }
}

/// Terms that the differences of one sector add to the equations of the in-phase motion, and
/// what couples the two: with the sector's own masses M_δ,
/// (M + `mass`) θ̈ + `coupling`ᵀ δ̈ + b + `bias` = 0 and
/// `coupling` θ̈ + M_δ δ̈ + `difference_bias` = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallFormulas {
    /// Number of the transverse sector.
    pub sector: usize,
    /// Second order of the mass matrix of all links, lower triangle.
    pub mass: Vec<MatrixEntry>,
    /// First order of the rows of the mass matrix that are the sector's.
    pub coupling: Vec<MatrixEntry>,
    /// Second order of the other terms, for all links.
    pub bias: Vec<Expr>,
    /// First order of the other terms of the sector's links.
    pub difference_bias: Vec<Expr>,
    /// Second order of the energy.
    pub energy: Expr,
}

/// Differences of the named sectors, as they act back.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallMechanics {
    /// Energy of the motion without differences.
    pub energy: Expr,
    /// The sectors, in the order of the differences in the state.
    pub sectors: Vec<SmallFormulas>,
}

impl TransverseMechanics {
    /// The symbol with that number of the differences that act back, or of their rates.
    pub fn small_symbol(
        &self,
        index: usize,
        of: impl Fn(&TransverseFormulas) -> &[SymbolId],
    ) -> Option<SymbolId> {
        let sectors = self.small.iter().flat_map(|small| &small.sectors);
        let mut symbols = sectors.flat_map(|formulas| of(&self.sectors[formulas.sector]));
        symbols.nth(index).copied()
    }
}

impl SmallMechanics {
    /// Place of the differences of each sector among those of all, in their order, and
    /// behind them the number of all.
    pub fn offsets(&self, transverse: &TransverseMechanics) -> Vec<usize> {
        let mut offsets = vec![0];
        for formulas in &self.sectors {
            let links = transverse.sectors[formulas.sector].sector.links;
            offsets.push(offsets[offsets.len() - 1] + links);
        }
        offsets
    }
}
