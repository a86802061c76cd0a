//! Small differences that act back on the motion that they are beside.
//!
//! With copies at θ + e δ, Σ e = 0 and Σ e² = their number, the Lagrangian of the whole
//! tree is L₀(θ, ω) + L₂(θ, ω; δ, δ̇) to second order, where L₂ is half the second
//! derivative of L₀ along (δ, δ̇), for one of the holders. All equations follow from the
//! sum, so that the model keeps an energy of its own. The Euler–Lagrange operator is linear:
//! those of θ get half the second derivative of their own terms, and those of δ are
//! the transverse equations at the accelerations that come of it.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, SymbolId};
use super::frame::DerivedFrame;
use super::transverse::{SmallMotion, TransverseFormulas};
use super::{MatrixEntry, TransverseMechanics};

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

impl Derivation<'_> {
    pub(super) fn small(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        transverse: &[TransverseFormulas],
    ) -> Option<SmallMechanics> {
        let wanted = &self.scene.requests.small;
        if wanted.is_empty() {
            return None;
        }
        let kinetic: Formula = frame.kinetic_terms().map(|(_, _, term)| term).sum();
        let energy = (&kinetic + &frame.potential).expand();
        let bias = frame.bias(self);
        let sectors = wanted.iter().map(|&number| {
            self.small_sector(
                frame,
                small,
                (number, &transverse[number]),
                (&energy, &bias),
            )
        });
        Some(SmallMechanics {
            sectors: sectors.collect(),
            energy: self.expr(&energy),
        })
    }

    fn small_sector(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        (number, TransverseFormulas { sector, .. }): (usize, &TransverseFormulas),
        (energy, bias): (&Formula, &[Formula]),
    ) -> SmallFormulas {
        let block = sector.first.0..sector.first.0 + sector.links;
        let holders = Formula::integer(i64::try_from(sector.holders).unwrap_or(i64::MAX));
        let of_one = |formula: &Formula| self.expr(&(&holders.pow(-1) * formula).expand());
        let along = |formula: &Formula| self.linearised(frame, small, formula, block.clone());
        let first = |formula: &Formula| of_one(&along(formula));
        let half = Formula::integer(2).pow(-1);
        let second = |formula: &Formula| of_one(&(&half * &along(&along(formula))));
        let entry = |(row, column, value)| MatrixEntry { row, column, value };
        let nonzero = |entry: &MatrixEntry| !entry.value.is_zero();
        let mass = frame.mass.iter();
        let mass = mass.map(|(row, column, value)| entry((row, column, second(value))));
        let rows = block.clone().enumerate();
        let coupling = rows.flat_map(|(row, link)| {
            (0..bias.len()).map(move |column| (row, column, frame.mass.get(link, column)))
        });
        let coupling = coupling.map(|(row, column, value)| entry((row, column, first(&value))));
        SmallFormulas {
            sector: number,
            mass: mass.filter(nonzero).collect(),
            coupling: coupling.filter(nonzero).collect(),
            bias: bias.iter().map(second).collect(),
            difference_bias: bias[block.clone()].iter().map(first).collect(),
            energy: second(energy),
        }
    }
}
