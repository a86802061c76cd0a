//! Equations of small differences between identical copies: differences that only follow an
//! in-phase motion, and differences that also act back on it.

use super::MatrixEntry;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::frame::DerivedFrame;
use crate::scene::TransverseCopies;
use std::collections::BTreeMap;
use std::ops::Range;

/// Equations of one sector (the small differences between copies in phase): M δ̈ + residual = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseFormulas {
    /// Copies and links of the sector.
    pub sector: TransverseCopies,
    /// Differences δ of the sector's links, in rad.
    pub differences: Vec<SymbolId>,
    /// Rates δ̇ of the differences, in rad/s.
    pub rates: Vec<SymbolId>,
    /// Mass matrix M of the sector, lower triangle. It counts the copies of a single holder (a link
    /// that holds such copies).
    pub mass: Vec<MatrixEntry>,
    /// Terms linear in the differences and their rates, including friction and drag.
    pub residual: Vec<Expr>,
    /// Energy of the differences between the copies of a single holder.
    pub energy: Expr,
    /// Rate of change of that energy without friction and drag.
    pub transfer: Expr,
    /// Power of friction and drag on that energy; zero without both.
    pub friction: Expr,
    /// True if that power depends on the in-phase motion, as it does if friction is not viscous.
    pub braked: bool,
}

/// Small differences of all sectors, and the accelerations of the in-phase motion on which their
/// equations depend.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseMechanics {
    /// Accelerations of the scene's links, in rad/s².
    pub accelerations: Vec<SymbolId>,
    /// Equations of each sector.
    pub sectors: Vec<TransverseFormulas>,
    /// Small differences that act back on the in-phase motion, if requested.
    pub small: Option<SmallMechanics>,
}

/// Symbols of small deviations of all links from the in-phase motion.
pub(super) struct SmallMotion {
    pub(super) accelerations: Vec<SymbolId>,
    pub(super) differences: Vec<SymbolId>,
    pub(super) rates: Vec<SymbolId>,
    /// Relative angles and rates of joints, by their symbols: the link, and the deviation of the
    /// relative value if the parent does not deviate and if it does.
    pub(super) joints: BTreeMap<SymbolId, (usize, [Formula; 2])>,
    /// Differences of copies from their mean, which are zero in phase, by their symbols: the link
    /// that represents the copies, and the deviation.
    pub(super) copies: BTreeMap<SymbolId, (usize, Formula)>,
}

impl SmallMotion {
    pub(super) fn difference(&self, link: usize) -> Formula {
        Formula::symbol(self.differences[link])
    }

    pub(super) fn rate(&self, link: usize) -> Formula {
        Formula::symbol(self.rates[link])
    }

    /// Returns the formula for the in-phase motion, in which all differences are zero.
    pub(super) fn in_phase(&self, formula: &Formula) -> Formula {
        let zeros = self
            .copies
            .keys()
            .map(|&symbol| (symbol, Formula::zero()))
            .collect::<Vec<_>>();
        formula.substitute(&zeros)
    }

    /// Returns the deviation of the angle or rate `symbol` (of a link or a joint) from the in-phase
    /// motion, if only the links in `block` deviate. Returns `None` if the symbol is neither an
    /// angle nor a rate.
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
            // Only these copies differ from each other.
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

/// Terms that the differences δ of one sector add to the in-phase equations, and the coupling of
/// the two. With the sector's own mass matrix M_δ:
/// (M + `mass`) θ̈ + `coupling`ᵀ δ̈ + b + `bias` = 0 and
/// `coupling` θ̈ + M_δ δ̈ + `difference_bias` = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallFormulas {
    /// Index of the transverse sector.
    pub sector: usize,
    /// Second-order part of the mass matrix of all links, lower triangle.
    pub mass: Vec<MatrixEntry>,
    /// First-order part of the sector's rows of the mass matrix.
    pub coupling: Vec<MatrixEntry>,
    /// Second-order part of all terms without accelerations, one per link.
    pub bias: Vec<Expr>,
    /// First-order part of all terms without accelerations, one per link of the sector.
    pub difference_bias: Vec<Expr>,
    /// Second-order part of the energy.
    pub energy: Expr,
}

/// Formulas for small differences between copies that act back on the in-phase motion.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallMechanics {
    /// Energy of the motion without differences.
    pub energy: Expr,
    /// Terms of each sector, in the order of the differences in the state.
    pub sectors: Vec<SmallFormulas>,
}

impl TransverseMechanics {
    /// Returns the symbol of a small difference that acts back on the in-phase motion, or of its
    /// rate. `index` is its index in the state.
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
    /// Returns the index of the first difference of each sector in the state, followed by the
    /// number of all differences.
    pub fn offsets(&self, transverse: &TransverseMechanics) -> Vec<usize> {
        let mut offsets = vec![0];
        for formulas in &self.sectors {
            let links = transverse.sectors[formulas.sector].sector.links;
            offsets.push(offsets[offsets.len() - 1] + links);
        }
        offsets
    }
}
