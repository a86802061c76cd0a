//! Small differences between copies that move in phase.
//!
//! A difference δ of what hangs from copies leaves the rest of the tree at rest to first
//! order, whatever the copies' number: the forces of the copies on what holds them
//! cancel. So the equations of motion of the copies' links, linearised at fixed motion
//! of all others, are those of δ.

use super::MatrixEntry;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::expression::{Expr, Role, SymbolId};
use super::frame::DerivedFrame;
use super::small::SmallMechanics;
use crate::scene::TransverseCopies;
use std::ops::Range;

/// The equations of one sector: M δ̈ + residual = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseFormulas {
    /// Its links.
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
    /// Its rate without friction and drag.
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
    /// Those that act back, if any are asked for.
    pub small: Option<SmallMechanics>,
}

/// Symbols of the small motion of all links beside the in-phase one.
pub(super) struct SmallMotion {
    accelerations: Vec<SymbolId>,
    differences: Vec<SymbolId>,
    rates: Vec<SymbolId>,
}

impl SmallMotion {
    fn difference(&self, link: usize) -> Formula {
        Formula::symbol(self.differences[link])
    }

    fn rate(&self, link: usize) -> Formula {
        Formula::symbol(self.rates[link])
    }
}

impl Derivation<'_> {
    pub(super) fn transverse(&mut self, frame: &DerivedFrame) -> TransverseMechanics {
        let mut symbols = |role, code: &str, text: &str, latex: &str| {
            self.indexed_symbols(
                frame,
                role,
                code,
                |name| format!("{text}_{name}"),
                |name| format!("{latex}_{{\\mathrm{{{name}}}}}"),
            )
        };
        let small = SmallMotion {
            accelerations: symbols(Role::Acceleration, "alpha", "α", "\\alpha"),
            differences: symbols(Role::Derived, "delta", "δ", "\\delta"),
            rates: symbols(Role::Derived, "delta_rate", "δ̇", "\\dot\\delta"),
        };
        let balances = self.balances(frame, &small);
        let sectors = self.scene.transverse_sectors().into_iter();
        let sectors: Vec<TransverseFormulas> = sectors
            .map(|sector| self.transverse_sector(frame, &small, &balances, sector))
            .collect();
        TransverseMechanics {
            small: self.small(frame, &small, &sectors),
            sectors,
            accelerations: small.accelerations,
        }
    }

    /// M α + b of each link, zero along the motion.
    fn balances(&self, frame: &DerivedFrame, small: &SmallMotion) -> Vec<Formula> {
        let rows = frame.bias(self).into_iter().enumerate();
        let rows = rows.map(|(i, bias)| {
            let accelerations = small.accelerations.iter().enumerate();
            let inertia =
                accelerations.map(|(k, &id)| &frame.mass.get(i, k) * &Formula::symbol(id));
            inertia.sum::<Formula>() + bias
        });
        rows.collect()
    }

    fn transverse_sector(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        balances: &[Formula],
        sector: TransverseCopies,
    ) -> TransverseFormulas {
        let block = sector.first.0..sector.first.0 + sector.links;
        let holders = Formula::integer(i64::try_from(sector.holders).unwrap_or(i64::MAX));
        let shared = |formula: &Formula| self.expr(&(&holders.pow(-1) * formula).expand());
        let residual: Vec<Formula> = block
            .clone()
            .map(|i| self.linearised(frame, small, &balances[i], block.clone()))
            .collect();
        let forces = frame.dissipative_forces();
        let friction: Formula = block
            .clone()
            .map(|i| &self.linearised(frame, small, &forces[i], block.clone()) * &small.rate(i))
            .sum();
        let energy = self.small_energy(frame, small, block.clone());
        // M δ̈ is −r, which has friction in it.
        let mut change = self.rate_at_steady_rates(frame, small, &energy, block.clone());
        for (i, residual) in block.clone().zip(&residual) {
            change = &change - &(residual * &small.rate(i));
        }
        let transfer = &change - &friction;
        let entries = block
            .clone()
            .flat_map(|row| (block.start..=row).map(move |column| (row, column)));
        let entries = entries.map(|(row, column)| MatrixEntry {
            row: row - block.start,
            column: column - block.start,
            value: shared(&frame.mass.get(row, column)),
        });
        TransverseFormulas {
            mass: entries.filter(|entry| !entry.value.is_zero()).collect(),
            differences: small.differences[block.clone()].to_vec(),
            rates: small.rates[block.clone()].to_vec(),
            residual: residual.iter().map(shared).collect(),
            energy: shared(&energy),
            transfer: shared(&transfer),
            friction: shared(&friction),
            braked: frame
                .torques
                .iter()
                .any(|torque| friction.symbols().contains(&torque.slopes[0])),
            sector,
        }
    }

    /// The part of a function of angles and velocities that is linear in the small motion
    /// of these links.
    pub(super) fn linearised(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        function: &Formula,
        block: Range<usize>,
    ) -> Formula {
        let terms = block.map(|j| {
            let stiffness = self.partial(function, frame.coordinates[j]);
            let damping = self.velocity_slope(frame, function, frame.velocities[j]);
            &(&stiffness * &small.difference(j)) + &(&damping * &small.rate(j))
        });
        terms.sum::<Formula>().expand()
    }

    /// ½ Σ M_ij δ̇_i δ̇_j + ½ Σ K_ij δ_i δ_j with K = ∂²U/∂θ∂θ where all angles are zero.
    fn small_energy(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        block: Range<usize>,
    ) -> Formula {
        let gradient = frame.potential_gradient(self);
        let angles = frame.coordinates.iter();
        let zero_angles: Vec<(SymbolId, Formula)> = angles
            .flat_map(|&angle| {
                [
                    (self.cos(angle), Formula::integer(1)),
                    (self.sin(angle), Formula::zero()),
                ]
            })
            .collect();
        let pairs = block
            .clone()
            .flat_map(|i| block.clone().map(move |j| (i, j)));
        let terms = pairs.map(|(i, j)| {
            let stiffness = self.partial(&gradient[i], frame.coordinates[j]);
            let stiffness = stiffness.substitute(&zero_angles);
            let kinetic = &(&frame.mass.get(i, j) * &small.rate(i)) * &small.rate(j);
            &kinetic + &(&(&stiffness * &small.difference(i)) * &small.difference(j))
        });
        let twice = terms.sum::<Formula>();
        (&Formula::integer(2).pow(-1) * &twice).expand()
    }

    /// Σ ∂E/∂θ_k ω_k + Σ ∂E/∂δ_i δ̇_i: dE/dt without the accelerations of the differences.
    fn rate_at_steady_rates(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        energy: &Formula,
        block: Range<usize>,
    ) -> Formula {
        let turning = self.coordinates_of(energy).into_iter().map(|coordinate| {
            let omega = Formula::symbol(frame.velocities[frame.index(coordinate)]);
            &self.partial(energy, coordinate) * &omega
        });
        let changing = block.map(|i| &energy.derivative(small.differences[i]) * &small.rate(i));
        turning.chain(changing).sum()
    }
}
