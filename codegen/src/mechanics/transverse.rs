//! Small differences between copies that move in phase.
//!
//! A difference δ of what hangs from copies leaves the rest of the tree at rest to first
//! order, whatever the copies' number: the forces of the copies on what holds them
//! cancel. So the equations of motion of the copies' links, linearised at fixed motion
//! of all others, are those of δ.

use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, Role, SymbolId};
use super::frame::DerivedFrame;
use super::{MatrixEntry, print::latex_name};
use crate::scene::TransverseSector;

/// The equations of one sector: M δ̈ + residual = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseFormulas {
    /// Its links.
    pub sector: TransverseSector,
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
    /// Its rate without friction and drag.
    pub transfer: Expr,
    /// The power of friction and drag on it; zero without both.
    pub friction: Expr,
}

/// All sectors, with the accelerations of the in-phase motion that drive them.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseMechanics {
    /// Accelerations of the scene's links.
    pub accelerations: Vec<SymbolId>,
    /// The sectors.
    pub sectors: Vec<TransverseFormulas>,
}

impl Derivation<'_> {
    pub(super) fn transverse(&mut self, frame: &DerivedFrame) -> TransverseMechanics {
        let names: Vec<String> = self.scene.links.iter().map(|l| l.name.clone()).collect();
        let mut all = |role, code: &str, text: &str, latex: &str| -> Vec<SymbolId> {
            let symbol = |name: &String| {
                self.symbols.intern(
                    role,
                    &format!("{code}_{name}"),
                    &format!("{text}_{name}"),
                    &format!("{latex}_{{\\mathrm{{{}}}}}", latex_name(name)),
                )
            };
            names.iter().map(symbol).collect()
        };
        let accelerations = all(Role::Acceleration, "alpha", "α", "\\alpha");
        let differences = all(Role::Derived, "delta", "δ", "\\delta");
        let rates = all(Role::Derived, "delta_rate", "δ̇", "\\dot\\delta");
        let bias = frame.bias(self);
        let gradient = frame.potential_gradient(self);
        let forces = frame.dissipative_forces();
        let sectors = self.scene.transverse_sectors();
        let sectors = sectors.into_iter().map(|sector| {
            let block = sector.first.0..sector.first.0 + sector.links;
            let holders = Formula::integer(i64::try_from(sector.holders).unwrap_or(i64::MAX));
            let share = holders.pow(-1);
            let shared = |formula: &Formula| (&share * formula).expand();
            let symbol = Formula::symbol;
            let mut residual = Vec::with_capacity(sector.links);
            let mut mass = Vec::new();
            let (mut energy, mut transfer, mut friction) = (Vec::new(), Vec::new(), Vec::new());
            for i in block.clone() {
                // M α + bias vanishes along the motion, so that its slope is all.
                let row =
                    (0..names.len()).map(|k| &frame.mass.get(i, k) * &symbol(accelerations[k]));
                let balance: Formula = row.sum::<Formula>() + bias[i].clone();
                let mut terms = Vec::new();
                for j in block.clone() {
                    let (delta, rate) = (symbol(differences[j]), symbol(rates[j]));
                    let stiffness = self.partial(&balance, frame.coordinates[j]).expand();
                    let damping = bias[i].derivative(frame.velocities[j]).expand();
                    terms.push(&stiffness * &delta);
                    terms.push(&damping * &rate);
                    let entry = frame.mass.get(i, j);
                    let force = forces[i].derivative(frame.velocities[j]);
                    friction.push(&(&force * &rate) * &symbol(rates[i]));
                    let spring =
                        self.at_rest(&self.partial(&gradient[i], frame.coordinates[j]), frame);
                    transfer.push(&(&spring * &delta) * &symbol(rates[i]));
                    let pair = &symbol(rates[i]) * &rate;
                    let half = Formula::integer(2).pow(-1);
                    energy.push(
                        &half
                            * &(&(&entry * &pair)
                                + &(&(&spring * &delta) * &symbol(differences[i]))),
                    );
                    // ½ δ̇ᵀ Ṁ δ̇
                    for coordinate in self.coordinates_of(&entry) {
                        let slope = self.partial(&entry, coordinate);
                        let turning = symbol(frame.velocities[frame.index(coordinate)]);
                        transfer.push(&half * &(&(&slope * &turning) * &pair));
                    }
                    if j <= i && !entry.is_zero() {
                        mass.push(MatrixEntry {
                            row: i - sector.first.0,
                            column: j - sector.first.0,
                            value: self.expr(&shared(&entry)),
                        });
                    }
                }
                let linear: Formula = terms.into_iter().sum();
                transfer.push(-(&linear * &symbol(rates[i])));
                residual.push(self.expr(&shared(&linear)));
            }
            let [energy, transfer, friction] =
                [energy, transfer, friction].map(|terms| shared(&terms.into_iter().sum()));
            // The residual has friction in it, which is no transfer.
            let transfer = (&transfer - &friction).expand();
            TransverseFormulas {
                differences: differences[block.clone()].to_vec(),
                rates: rates[block].to_vec(),
                sector,
                mass,
                residual,
                energy: self.expr(&energy),
                transfer: self.expr(&transfer),
                friction: self.expr(&friction),
            }
        });
        let sectors = sectors.collect();
        TransverseMechanics {
            accelerations,
            sectors,
        }
    }

    /// A formula where all angles are zero.
    fn at_rest(&self, formula: &Formula, frame: &DerivedFrame) -> Formula {
        let angles = frame.coordinates.iter();
        let values = angles.flat_map(|&angle| {
            [
                (self.cos(angle), Formula::integer(1)),
                (self.sin(angle), Formula::zero()),
            ]
        });
        formula.substitute(&values.collect::<Vec<_>>()).expand()
    }
}
