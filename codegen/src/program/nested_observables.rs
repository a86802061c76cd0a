//! Quantities that observables of nested copies use, computed on means and differences: momenta,
//! forces, energies, and solutions of systems with the mass matrix. Components that are zero by
//! symmetry are exactly zero here too.

use super::ValueId;
use super::entry_state::{motion, symmetric_tree, values};
use super::lower::{Environment, Lowering};
use super::sectors::by_coordinate;
use super::symmetric::{ConstantValues, Fields, MassFactors, SymmetricTree};
use crate::functions::EntryState;
use crate::mechanics::expression::SymbolId;
use crate::mechanics::{LinearSystem, ObservableFrame, OrbitMechanics};
use crate::scene::Scene;

/// Computes quantities for observables of nested copies.
pub(super) struct NestedObservables<'s> {
    scene: &'s Scene,
    values: ConstantValues,
    /// Factors of the mass matrix at the given coordinates.
    factors: MassFactors,
}

impl<'s> NestedObservables<'s> {
    pub(super) fn new(
        lowering: &mut Lowering<'_>,
        scene: &'s Scene,
        sectors: &OrbitMechanics,
    ) -> Self {
        let mechanics = lowering.mechanics;
        let values = values(lowering, sectors);
        let mut tree = symmetric_tree(lowering, None);
        let motion = motion(&mut tree, scene, mechanics, &values, EntryState::Rates);
        let factors = tree.factors(&values, &motion.pose);
        Self {
            scene,
            values,
            factors,
        }
    }

    /// Computes the symbols that are `used` and sets their values in `state`.
    pub(super) fn supply(
        &self,
        lowering: &mut Lowering<'_>,
        used: &ObservableFrame,
        environment: &mut Environment<'_>,
        state: EntryState,
    ) {
        let (mechanics, values, used) = (lowering.mechanics, &self.values, &used.nested);
        let mut tree = symmetric_tree(lowering, None);
        let motion = motion(&mut tree, self.scene, mechanics, values, state);
        let mut found: Vec<(SymbolId, ValueId)> = Vec::new();
        let mut project = |tree: &mut _, symbols: &[SymbolId], fields: &Fields| {
            let projected = by_coordinate(tree, mechanics, fields, SymmetricTree::projected);
            found.extend(symbols.iter().copied().zip(projected));
        };
        if state == EntryState::Rates {
            project(&mut tree, &environment.frame.momenta, &motion.momenta);
        }
        let kinetic = tree.kinetic_gradient(&motion.pose, &motion.rates);
        let potential = tree.potential_gradient(values, &motion.pose);
        if let Some(energies) = &used.energies {
            project(&mut tree, &energies.kinetic_slopes, &kinetic);
            project(&mut tree, &energies.potential_slopes, &potential);
        }
        let mut forces = tree.subtract(&kinetic, &potential);
        tree.drive(&mut forces, values, &motion.pose);
        project(&mut tree, &used.forces, &forces);
        // At fixed momenta the slope of K has the opposite sign.
        let slopes = forces.iter().map(|force| tree.neg(force)).collect();
        project(&mut tree, &used.slopes, &slopes);
        let changes = tree.mass_changes(&motion.pose, &motion.rates);
        project(&mut tree, &used.changes, &changes);
        let friction = tree.friction_forces(values, &motion.rates);
        project(&mut tree, &used.torques, &friction);
        let mut component = |tree: &mut _, symbols: &[SymbolId], fields: &Fields| {
            let components = by_coordinate(tree, mechanics, fields, SymmetricTree::component);
            found.extend(symbols.iter().copied().zip(components));
        };
        if state != EntryState::Rates {
            component(&mut tree, &environment.frame.velocities, &motion.rates);
        }
        if !used.friction_accelerations.is_empty() {
            let accelerations = tree.solve(&self.factors, &friction);
            component(&mut tree, &used.friction_accelerations, &accelerations);
        }
        if let Some(energies) = &used.energies {
            let kinetic = tree.kinetic_energy(&motion);
            let potential = tree.potential_energy(values, &motion.pose);
            found.push((energies.kinetic, tree.series.total(&kinetic)));
            found.push((energies.potential, tree.series.total(&potential)));
        }
        for (symbol, value) in found {
            let code = &mechanics.symbols.get(symbol).code;
            lowering.builder.name(value, code);
            environment.supply(symbol, value);
        }
    }

    /// Solves a system with the mass matrix and sets the values of its unknowns.
    pub(super) fn solve(
        &self,
        lowering: &mut Lowering<'_>,
        environment: &mut Environment<'_>,
        system: &LinearSystem,
    ) {
        let mechanics = lowering.mechanics;
        let right: Vec<ValueId> = system
            .right
            .iter()
            .map(|right| lowering.expr(environment, right))
            .collect();
        let mut tree = symmetric_tree(lowering, None);
        let mut momenta = tree.zeros();
        for (coordinate, &value) in mechanics.coordinates.iter().zip(&right) {
            if !tree.series.builder.is(value, 0) {
                let (orbit, sector) = coordinate.kind.orbit_and_difference();
                let value = tree.series.value(value);
                momenta[orbit].set(sector, value);
            }
        }
        let momenta = tree.per_link(&momenta);
        let solution = tree.solve(&self.factors, &momenta);
        let solution = by_coordinate(&mut tree, mechanics, &solution, SymmetricTree::component);
        for (&symbol, value) in system.unknowns.iter().zip(solution) {
            let code = &mechanics.symbols.get(symbol).code;
            lowering.builder.name(value, code);
            environment.supply(symbol, value);
        }
    }
}
