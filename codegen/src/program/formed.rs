//! Quantities that observables of nested trees refer to, formed on means and
//! differences: momenta, forces, energies, and the solves with the mass matrix.
//! Components that the symmetry makes zero are exactly zero here too.

use super::ValueId;
use super::copies::{Copies, Factors, Fields, Orbit, Values, orbits};
use super::handed::{State, copies, motion, values};
use super::lower::{Door, Lowering};
use super::sectors::by_coordinate;
use crate::mechanics::expression::SymbolId;
use crate::mechanics::{ObservableFrame, Sectors, System};
use crate::scene::Scene;

/// A nested tree on which observables are formed.
pub(super) struct Formed<'s> {
    scene: &'s Scene,
    orbits: Vec<Orbit>,
    values: Values,
    /// The mass matrix at the coordinates that are handed over.
    factors: Factors,
}

impl<'s> Formed<'s> {
    pub(super) fn new(lowering: &mut Lowering<'_>, scene: &'s Scene, sectors: &Sectors) -> Self {
        let mechanics = lowering.mechanics;
        let orbits = orbits(scene, &mechanics.coordinates);
        let values = values(lowering, sectors);
        let mut copies = copies(lowering, &orbits, None);
        let motion = motion(&mut copies, scene, mechanics, &values, State::Rates);
        let factors = copies.factors(&values, &motion.pose);
        Self {
            scene,
            orbits,
            values,
            factors,
        }
    }

    /// Hands over what is `used`, in a state that is handed over as `state`
    /// says.
    pub(super) fn supply(
        &self,
        lowering: &mut Lowering<'_>,
        used: &ObservableFrame,
        door: &mut Door<'_>,
        state: State,
    ) {
        let (mechanics, values, used) = (lowering.mechanics, &self.values, &used.formed);
        let mut copies = copies(lowering, &self.orbits, None);
        let motion = motion(&mut copies, self.scene, mechanics, values, state);
        let mut found: Vec<(SymbolId, ValueId)> = Vec::new();
        let mut project = |copies: &mut _, symbols: &[SymbolId], fields: &Fields| {
            let projected = by_coordinate(copies, mechanics, fields, Copies::projected);
            found.extend(symbols.iter().copied().zip(projected));
        };
        if state == State::Rates {
            project(&mut copies, &door.frame.momenta, &motion.momenta);
        }
        let kinetic = copies.kinetic_gradient(&motion.pose, &motion.rates);
        let potential = copies.potential_gradient(values, &motion.pose);
        if let Some(energies) = &used.energies {
            project(&mut copies, &energies.kinetic_slopes, &kinetic);
            project(&mut copies, &energies.potential_slopes, &potential);
        }
        let mut forces = copies.subtract(&kinetic, &potential);
        copies.drive(&mut forces, values, &motion.pose);
        project(&mut copies, &used.forces, &forces);
        // At fixed momenta K has the opposite slope.
        let slopes = forces.iter().map(|force| copies.neg(force)).collect();
        project(&mut copies, &used.slopes, &slopes);
        let changes = copies.mass_changes(&motion.pose, &motion.rates);
        project(&mut copies, &used.changes, &changes);
        let friction = copies.friction_forces(values, &motion.rates);
        project(&mut copies, &used.torques, &friction);
        let mut component = |copies: &mut _, symbols: &[SymbolId], fields: &Fields| {
            let components = by_coordinate(copies, mechanics, fields, Copies::component);
            found.extend(symbols.iter().copied().zip(components));
        };
        if state != State::Rates {
            component(&mut copies, &door.frame.velocities, &motion.rates);
        }
        if !used.friction_accelerations.is_empty() {
            let accelerations = copies.solve(&self.factors, &friction);
            component(&mut copies, &used.friction_accelerations, &accelerations);
        }
        if let Some(energies) = &used.energies {
            let kinetic = copies.kinetic_energy(&motion);
            let potential = copies.potential_energy(values, &motion.pose);
            found.push((energies.kinetic, copies.graded.total(&kinetic)));
            found.push((energies.potential, copies.graded.total(&potential)));
        }
        for (symbol, value) in found {
            let code = &mechanics.symbols.get(symbol).code;
            lowering.builder.name(value, code);
            door.supply(symbol, value);
        }
    }

    /// Solves a system with the mass matrix and hands its unknowns over.
    pub(super) fn solve(&self, lowering: &mut Lowering<'_>, door: &mut Door<'_>, system: &System) {
        let mechanics = lowering.mechanics;
        let right: Vec<ValueId> = system
            .right
            .iter()
            .map(|right| lowering.expr(door, right))
            .collect();
        let mut copies = copies(lowering, &self.orbits, None);
        let mut momenta = copies.zeros();
        for (coordinate, &value) in mechanics.coordinates.iter().zip(&right) {
            if !copies.graded.builder.is(value, 0) {
                let (orbit, which) = coordinate.kind.place();
                let value = copies.graded.value(value);
                momenta[orbit].set(which, value);
            }
        }
        let momenta = copies.per_link(&momenta);
        let solution = copies.solve(&self.factors, &momenta);
        let solution = by_coordinate(&mut copies, mechanics, &solution, Copies::component);
        for (&symbol, value) in system.unknowns.iter().zip(solution) {
            let code = &mechanics.symbols.get(symbol).code;
            lowering.builder.name(value, code);
            door.supply(symbol, value);
        }
    }
}
