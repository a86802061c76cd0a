//! Entry points of small differences that act back on the motion that they are beside.

use super::entry_list::EntryList;
use super::lower::Environment;
use crate::functions::{Argument, Purpose};
use crate::mechanics::{Mechanics, SmallMechanics, TransverseMechanics};
use crate::scene::Scene;

impl EntryList<'_, '_> {
    /// One linear system for the accelerations of angles and differences, without torques
    /// from outside and under them where they are asked for, and the energy.
    pub(super) fn small(
        &mut self,
        scene: &Scene,
        mechanics: &Mechanics,
        transverse: &TransverseMechanics,
        small: &SmallMechanics,
    ) {
        use Argument::{Omega, SmallDifferences, SmallRates, SmallTorques, Theta, Torques};
        let frame = &mechanics.absolute;
        let links = frame.coordinates.len();
        let names = self.lowering.coordinate_names(frame);
        let mut motion = Environment::new(frame, Theta, Some(Omega), None);
        let mut matrix = self.lowering.mass_matrix(&mut motion);
        let mut residual = self.exprs(&mut motion, &frame.bias);
        let mut energy = self.lowering.expr(&mut motion, &small.energy);
        let mut unknowns = names.clone();
        for (formulas, offset) in small.sectors.iter().zip(small.offsets(transverse)) {
            let of_sector = &transverse.sectors[formulas.sector];
            let sector = &of_sector.sector;
            let mut environment = motion.clone();
            for (symbols, argument) in [
                (&of_sector.differences, SmallDifferences),
                (&of_sector.rates, SmallRates),
            ] {
                for (index, &symbol) in symbols.iter().enumerate() {
                    let value = self.lowering.builder.input(argument, offset + index);
                    environment.supply(symbol, value);
                }
            }
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
            let right = residual.iter().enumerate().map(|(index, &value)| {
                let torque = match index.checked_sub(links) {
                    None => builder.input(Torques, index),
                    Some(difference) => builder.input(SmallTorques, difference),
                };
                builder.sub(torque, value)
            });
            let right = right.collect();
            let outputs = builder.solve(matrix, right, &unknowns);
            self.push(Purpose::SmallAccelerationsUnder, outputs);
        }
        self.push(Purpose::SmallEnergy, vec![energy]);
    }
}
