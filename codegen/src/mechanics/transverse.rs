//! Small differences between copies that move in phase.
//!
//! A difference δ between copies leaves the rest of the tree unchanged to first order, for any
//! number of copies, because the forces of the copies on their holder cancel. The equations of δ
//! are therefore the equations of motion of the copies' links, linearised while all other links
//! follow the in-phase motion.

use super::MatrixEntry;
use super::algebra::Formula;
use super::derivation::Derivation;
use super::differences::{SmallMotion, TransverseFormulas, TransverseMechanics};
use super::expression::{Role, SymbolId};
use super::frame::DerivedFrame;
use super::joint::JointQuantity;
use crate::scene::TransverseCopies;
use std::collections::BTreeMap;
use std::ops::Range;

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
        let mut small = SmallMotion {
            accelerations: symbols(Role::Acceleration, "alpha", "α", "\\alpha"),
            differences: symbols(Role::Derived, "delta", "δ", "\\delta"),
            rates: symbols(Role::Derived, "delta_rate", "δ̇", "\\dot\\delta"),
            joints: BTreeMap::new(),
            copies: BTreeMap::new(),
        };
        self.small_joints(frame, &mut small);
        let coupled = self.with_siblings(frame, &mut small);
        let frame = &coupled;
        let balances = self.balances(frame, &small);
        let sectors = self.scene.transverse_sectors().into_iter();
        let sectors: Vec<TransverseFormulas> = sectors
            .map(|sector| self.transverse_sector(frame, &small, &balances, sector))
            .collect();
        let acting = self.small(frame, &small, &sectors);
        for symbol in small.copies.keys() {
            self.joints.remove(symbol);
        }
        TransverseMechanics {
            small: acting,
            sectors,
            accelerations: small.accelerations,
        }
    }

    /// Derives the deviations of the joints' relative angles and rates.
    fn small_joints(&mut self, frame: &DerivedFrame, small: &mut SmallMotion) {
        for (quantity, of_links, changes) in [
            (
                JointQuantity::SmallAngle,
                &frame.coordinates,
                &small.differences,
            ),
            (JointQuantity::SmallRate, &frame.velocities, &small.rates),
        ] {
            for (link, own) in of_links.iter().enumerate() {
                let Some((symbol, _)) = self.joint_in(*own) else {
                    continue;
                };
                let relative = self.joint_of(quantity, link, changes, Formula::zero());
                let changes = [Formula::symbol(changes[link]), relative];
                small.joints.insert(symbol, (link, changes));
            }
        }
    }

    /// Returns M α + b for each link, which is zero along the motion (α are the accelerations).
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
        let friction = self.small_friction(frame, small, block.clone());
        let energy = self.small_energy(frame, small, block.clone());
        // M δ̈ equals −r, and r includes friction.
        let forces = frame.dissipative_forces(self);
        let mut transfer = self.rate_at_steady_rates(frame, small, &energy, block.clone());
        for (i, residual) in block.clone().zip(&residual) {
            let force = self.linearised(frame, small, &forces[i], block.clone());
            transfer = &transfer - &(&(residual + &force) * &small.rate(i));
        }
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

    /// Returns the part of a function of angles and velocities that is linear in the small motion
    /// of the given links.
    pub(super) fn linearised(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        function: &Formula,
        block: Range<usize>,
    ) -> Formula {
        let mut terms = Vec::new();
        for symbol in function.symbols() {
            let direct = small.change(self, frame, symbol, &block);
            let change = match direct {
                Some(change) => change,
                None => {
                    let through = block.clone().map(|j| {
                        let slope = |variable| self.slope(symbol, variable);
                        let turned =
                            slope(frame.coordinates[j]).map(|by| &by * &small.difference(j));
                        turned.unwrap_or_else(Formula::zero)
                    });
                    let braked = self.braking_change(frame, symbol, |rate| {
                        self.linearised(frame, small, rate, block.clone())
                    });
                    &through.sum::<Formula>() + &braked
                }
            };
            if !change.is_zero() {
                terms.push(&function.derivative(symbol) * &change);
            }
        }
        terms.into_iter().sum::<Formula>().expand()
    }

    /// Returns −Σ ∂²R/∂w∂w (δw)² over the rates w of links and joints, including those of friction
    /// that is not viscous.
    fn small_friction(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        block: Range<usize>,
    ) -> Formula {
        let rates = frame.dissipation.symbols().into_iter();
        let powers = rates.filter_map(|rate| {
            let change = small.change(self, frame, rate, &block)?;
            let torque = frame.dissipation.derivative(rate);
            Some(&self.linearised(frame, small, &torque, block.clone()) * &change)
        });
        -powers.sum::<Formula>()
    }

    /// Returns ½ Σ M_ij δ̇_i δ̇_j + ½ Σ K_ij δ_i δ_j, with K = ∂²U/∂θ∂θ at zero angles.
    fn small_energy(
        &self,
        frame: &DerivedFrame,
        small: &SmallMotion,
        block: Range<usize>,
    ) -> Formula {
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
        let kinetic =
            pairs.map(|(i, j)| &(&frame.mass.get(i, j) * &small.rate(i)) * &small.rate(j));
        let along = |function: &Formula| self.linearised(frame, small, function, block.clone());
        let potential = along(&along(&frame.potential)).substitute(&zero_angles);
        let twice = &kinetic.sum::<Formula>() + &potential;
        (&Formula::integer(2).pow(-1) * &twice).expand()
    }

    /// Returns Σ ∂E/∂θ_k ω_k + Σ ∂E/∂δ_i δ̇_i: dE/dt without the accelerations of the differences.
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
        let changing = block.map(|i| &self.partial(energy, small.differences[i]) * &small.rate(i));
        turning.chain(changing).sum()
    }
}
