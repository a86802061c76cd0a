//! Entry points for small differences between copies that move in phase.

use super::Entry;
use super::entry_list::EntryList;
use super::lower::Environment;
use crate::functions::{Argument, Purpose};
use crate::mechanics::{Mechanics, TransverseFormulas, TransverseMechanics};

impl EntryList<'_, '_> {
    pub(super) fn transverse(&mut self, mechanics: &Mechanics, all: &TransverseMechanics) {
        use Argument::{Alpha, Difference, DifferenceRate, Omega, Theta};
        let frame = &mechanics.absolute;
        let names = self.lowering.coordinate_names(frame);
        let is_driver = |entry: &&Entry| entry.purpose == Purpose::Accelerations;
        let driver = self.entries.iter().find(is_driver);
        let driver = driver.map_or_else(Vec::new, |entry| entry.outputs.clone());
        for (number, formulas) in all.sectors.iter().enumerate() {
            let TransverseFormulas {
                sector,
                differences,
                rates,
                mass,
                residual,
                energy,
                transfer,
                friction,
                braked,
            } = formulas;
            let mut environment = Environment::new(frame, Theta, Some(Omega), None);
            for (symbols, argument) in [
                (&all.accelerations, Alpha),
                (differences, Difference(number)),
                (rates, DifferenceRate(number)),
            ] {
                for (index, &symbol) in symbols.iter().enumerate() {
                    let value = self.lowering.builder.input(argument, index);
                    environment.supply(symbol, value);
                }
            }
            let block = sector.first.0..sector.first.0 + sector.links;
            let mut both = environment.clone();
            for (&symbol, &value) in all.accelerations.iter().zip(&driver) {
                both.supply(symbol, value);
            }
            let mut accelerations = |environment: &mut Environment<'_>| {
                let matrix = self.lowering.matrix(environment, mass);
                let right = self.exprs(environment, residual).into_iter();
                let right = right.map(|value| self.lowering.builder.neg(value));
                let right = right.collect();
                (self.lowering.builder).solve(matrix, right, &names[block.clone()])
            };
            let outputs = accelerations(&mut environment);
            let beside = accelerations(&mut both);
            self.push(Purpose::Transverse(number), outputs);
            let together = driver.iter().copied().chain(beside).collect();
            self.push(Purpose::TransverseMotion(number), together);
            let friction_power = Purpose::TransverseFriction(number, *braked);
            for (purpose, value) in [
                (Purpose::TransverseEnergy(number), energy),
                (Purpose::TransverseTransfer(number), transfer),
                (friction_power, friction),
            ] {
                if purpose != friction_power || !friction.is_zero() {
                    let value = self.lowering.expr(&mut environment, value);
                    self.push(purpose, vec![value]);
                }
            }
        }
    }
}
