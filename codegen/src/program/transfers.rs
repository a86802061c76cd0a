//! Entry points for the energy transfer into one difference.

use super::ValueId;
use super::entry_list::EntryList;
use super::lower::Environment;
use crate::functions::{Argument, CANONICAL, Cause, EntryState, Purpose};
use crate::mechanics::{EnergyParts, Frame, MeanTree, TransferFormulas, Truncated};
use crate::scene::{LinkId, Scene};

impl EntryList<'_, '_> {
    pub(super) fn transfer(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        number: usize,
        transfer: &TransferFormulas,
    ) {
        use Argument::{Coordinates, Momenta, Rates};
        let mechanics = self.lowering.mechanics;
        let mut phase = Environment::new(frame, Coordinates, None, Some(Momenta));
        let mut motion = Environment::new(frame, Coordinates, Some(Rates), None);
        let energy = self.parts(&mut phase, &transfer.energy);
        let total = self.lowering.builder.add(energy[0], energy[1]);
        self.push(Purpose::SubHamiltonian(number), vec![total]);
        for Truncated {
            counting,
            order,
            parts,
        } in &transfer.truncated
        {
            let outputs = self.parts(&mut phase, parts);
            let purpose = Purpose::TruncatedTransfer(number, *counting, *order);
            self.push(purpose, outputs);
        }
        if let Some(form) = &transfer.quadratic_form {
            let outputs = self.exprs(&mut phase, form);
            self.push(Purpose::QuadraticForm(number), outputs);
        }
        if let Some(parts) = &transfer.exact {
            let outputs = self.parts(&mut phase, parts);
            self.push(Purpose::ExactTransfer(number, CANONICAL), outputs);
            let outputs = self.parts(&mut motion, parts);
            self.push(Purpose::ExactTransfer(number, EntryState::Rates), outputs);
        }
        if let (Some(split), Some(mean_tree)) = (&transfer.split, &mechanics.mean_tree) {
            let split = (split, mean_tree);
            self.split(number, CANONICAL, split, &mut phase);
            self.split(number, EntryState::Rates, split, &mut motion);
        }
        self.antiphase_powers(scene, number, transfer, CANONICAL, &mut phase);
        self.antiphase_powers(scene, number, transfer, EntryState::Rates, &mut motion);
    }

    /// Adds the functions for the powers of friction and drive on the energy H_d of a difference.
    fn antiphase_powers(
        &mut self,
        scene: &Scene,
        number: usize,
        transfer: &TransferFormulas,
        state: EntryState,
        environment: &mut Environment<'_>,
    ) {
        if !transfer.friction.is_zero() {
            let power = self.lowering.expr(environment, &transfer.friction);
            self.push(Purpose::AntiphaseFrictionPower(number, state), vec![power]);
        }
        if !transfer.drive.is_zero() {
            let power = self.lowering.expr(environment, &transfer.drive);
            self.push(Purpose::AntiphaseDrivePower(number, state), vec![power]);
        }
        if scene.requests.forces {
            let velocity = self.lowering.expr(environment, &transfer.velocity);
            let coordinate = &self.lowering.mechanics.coordinates[transfer.coordinate];
            let builder = &mut self.lowering.builder;
            let mut torque = builder.integer(0);
            for &(LinkId(link), weight) in &coordinate.weights {
                let (weight, own) = (
                    builder.integer(weight),
                    builder.input(Argument::Torques, link),
                );
                let part = builder.mul(weight, own);
                torque = builder.add(torque, part);
            }
            let power = builder.mul(velocity, torque);
            self.push(Purpose::AntiphaseOutsidePower(number, state), vec![power]);
        }
    }

    /// Adds the functions for W, split into the contribution of the mean tree (the tree with mean
    /// constants) and that of the copies' mismatches.
    fn split(
        &mut self,
        number: usize,
        state: EntryState,
        ([growth, forcing], mean_tree): (&[EnergyParts; 2], &MeanTree),
        environment: &mut Environment<'_>,
    ) {
        let forcing = self.parts(environment, forcing);
        // At the same momenta the mean tree has different velocities.
        let coordinates = environment.coordinates;
        let mut mean = Environment::new(&mean_tree.frame, coordinates, None, environment.momenta);
        if environment.momenta.is_none() {
            let added = self.lowering.added(environment, mean_tree);
            for (&symbol, added) in environment.frame.velocities.iter().zip(added) {
                let whole = self.lowering.symbol(environment, symbol);
                let own = self.lowering.builder.sub(whole, added);
                mean.supply(symbol, own);
            }
        }
        let growth = self.parts(&mut mean, growth);
        for (cause, outputs) in [(Cause::MeanTree, growth), (Cause::Mismatch, forcing)] {
            self.push(Purpose::SplitTransfer(number, cause, state), outputs);
        }
    }

    fn parts(&mut self, environment: &mut Environment<'_>, parts: &EnergyParts) -> Vec<ValueId> {
        let kinetic = self.lowering.expr(environment, &parts.kinetic);
        let potential = self.lowering.expr(environment, &parts.potential);
        vec![kinetic, potential]
    }
}
