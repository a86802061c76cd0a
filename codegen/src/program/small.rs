//! Entry points for small differences that act back on the in-phase motion.

use super::ValueId;
use super::builder::Builder;
use super::entry_list::EntryList;
use super::lower::Environment;
use crate::functions::{Argument, Purpose};
use crate::mechanics::{Mechanics, SmallMechanics, TransverseFormulas, TransverseMechanics};
use crate::scene::Scene;

impl EntryList<'_, '_> {
    /// Adds a linear system for the accelerations of angles and differences, without external
    /// torques and, if requested, with them; and the energy.
    pub(super) fn small(
        &mut self,
        scene: &Scene,
        mechanics: &Mechanics,
        transverse: &TransverseMechanics,
        small: &SmallMechanics,
    ) {
        let frame = &mechanics.absolute;
        let links = frame.coordinates.len();
        let names = self.lowering.coordinate_names(frame);
        let mut motion = Environment::new(frame, Argument::Theta, Some(Argument::Omega), None);
        let mut matrix = self.lowering.mass_matrix(&mut motion);
        let mut residual = self.exprs(&mut motion, &frame.bias);
        let mut energy = self.lowering.expr(&mut motion, &small.energy);
        let mut unknowns = names.clone();
        for (formulas, offset) in small.sectors.iter().zip(small.offsets(transverse)) {
            let of_sector = &transverse.sectors[formulas.sector];
            let sector = &of_sector.sector;
            let mut environment = self.with_differences(&motion, of_sector, offset);
            for (place, added) in self.lowering.matrix(&mut environment, &formulas.mass) {
                let sum = match matrix.get(&place) {
                    Some(&mass) => self.lowering.builder.add(mass, added),
                    None => added,
                };
                matrix.insert(place, sum);
            }
            let first = links + offset;
            let coupling = self.lowering.matrix(&mut environment, &formulas.coupling);
            let coupling = coupling.into_iter();
            matrix.extend(coupling.map(|((row, column), value)| ((first + row, column), value)));
            let own = self.lowering.matrix(&mut environment, &of_sector.mass);
            let own = own.into_iter();
            matrix.extend(own.map(|((row, column), value)| ((first + row, first + column), value)));
            for (sum, added) in residual.iter_mut().zip(&formulas.bias) {
                if !added.is_zero() {
                    let added = self.lowering.expr(&mut environment, added);
                    *sum = self.lowering.builder.add(*sum, added);
                }
            }
            residual.extend(self.exprs(&mut environment, &formulas.difference_bias));
            let added = self.lowering.expr(&mut environment, &formulas.energy);
            energy = self.lowering.builder.add(energy, added);
            let below = &names[sector.first.0..sector.first.0 + sector.links];
            let name = |link: &String| format!("difference_{}_{link}", sector.name);
            unknowns.extend(below.iter().map(name));
        }
        let builder = &mut self.lowering.builder;
        let right = residual.iter().map(|&value| builder.neg(value)).collect();
        let pushed = scene.requests.forces.then(|| matrix.clone());
        let outputs = builder.solve(matrix, right, &unknowns);
        self.push(Purpose::SmallAccelerations, outputs);
        if let Some(matrix) = pushed {
            let builder = &mut self.lowering.builder;
            let right = under_torques(builder, &residual, links);
            let outputs = builder.solve(matrix, right, &unknowns);
            self.push(Purpose::SmallAccelerationsUnder, outputs);
        }
        self.push(Purpose::SmallEnergy, vec![energy]);
    }

    /// Returns the environment of the motion with the small differences of one sector, which begin
    /// at `offset` in the list of all differences.
    fn with_differences<'e>(
        &mut self,
        motion: &Environment<'e>,
        of_sector: &TransverseFormulas,
        offset: usize,
    ) -> Environment<'e> {
        let mut environment = motion.clone();
        for (symbols, argument) in [
            (&of_sector.differences, Argument::SmallDifferences),
            (&of_sector.rates, Argument::SmallRates),
        ] {
            for (index, &symbol) in symbols.iter().enumerate() {
                let value = self.lowering.builder.input(argument, offset + index);
                environment.supply(symbol, value);
            }
        }
        environment
    }
}

/// Returns the external torques on links and differences, minus the residuals of the equations of
/// motion.
fn under_torques(builder: &mut Builder, residual: &[ValueId], links: usize) -> Vec<ValueId> {
    let right = residual.iter().enumerate().map(|(index, &value)| {
        let torque = match index.checked_sub(links) {
            None => builder.input(Argument::Torques, index),
            Some(difference) => builder.input(Argument::SmallTorques, difference),
        };
        builder.sub(torque, value)
    });
    right.collect()
}
