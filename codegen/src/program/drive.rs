//! Functions of time, and the powers of drive, friction and external torques.

use super::ValueId;
use super::entry_list::EntryList;
use super::lower::{Environment, Lowering};
use crate::functions::{Argument, Purpose};
use crate::mechanics::expression::SymbolId;
use crate::mechanics::{DriveTerms, Mechanics, Temporal};
use crate::scene::Scene;

impl Lowering<'_> {
    /// Returns the value of a symbol that depends only on time.
    pub(super) fn temporal(
        &mut self,
        environment: &mut Environment<'_>,
        symbol: SymbolId,
    ) -> ValueId {
        let mechanics = self.mechanics;
        let Some(meaning) = mechanics
            .drive
            .as_ref()
            .and_then(|drive| drive.temporal.get(&symbol))
        else {
            unreachable!("what depends on time comes with a drive");
        };
        let value = match meaning {
            Temporal::Time => self.builder.input(Argument::Time, 0),
            Temporal::Sin(argument) => {
                let argument = self.expr(environment, argument);
                self.builder.sin(argument)
            }
            Temporal::Cos(argument) => {
                let argument = self.expr(environment, argument);
                self.builder.cos(argument)
            }
            Temporal::Given(value) => self.expr(environment, value),
        };
        let code = &mechanics.symbols.get(symbol).code;
        self.builder.name(value, code)
    }
}

impl EntryList<'_, '_> {
    /// Adds the drive as a function of time: acceleration of the root's pivot and torque on the
    /// root. Absent ones are zero.
    pub(super) fn drive(&mut self, mechanics: &Mechanics, drive: &DriveTerms) {
        let mut environment = Environment::new(&mechanics.absolute, Argument::Theta, None, None);
        let along = |axis: &str| {
            let motion = drive.pivot.iter().find(|motion| motion.name == axis);
            motion.and_then(|motion| motion.acceleration)
        };
        let outputs = [along("x"), along("y"), drive.torque].map(|symbol| match symbol {
            Some(symbol) => self.lowering.temporal(&mut environment, symbol),
            None => self.lowering.builder.integer(0),
        });
        self.push(Purpose::Drive, outputs.to_vec());
    }

    /// Adds the powers of drive, friction and external torques, which balance the rate of the
    /// energy.
    pub(super) fn powers(
        &mut self,
        scene: &Scene,
        mechanics: &Mechanics,
        environment: &mut Environment<'_>,
    ) {
        use Argument::{Omega, Torques};
        let drive = mechanics.drive.as_ref();
        if let Some(power) = drive.and_then(|drive| drive.power.as_ref()) {
            let power = self.lowering.expr(environment, power);
            self.push(Purpose::DrivePower, vec![power]);
        }
        if let Some(power) = &mechanics.friction_power {
            let power = self.lowering.expr(environment, power);
            self.push(Purpose::TotalFrictionPower, vec![power]);
        }
        if scene.requests.energies && scene.requests.forces {
            let builder = &mut self.lowering.builder;
            let mut power = builder.integer(0);
            for link in 0..scene.links.len() {
                let rate = builder.input(Omega, link);
                let torque = builder.input(Torques, link);
                let own = builder.mul(torque, rate);
                power = builder.add(power, own);
            }
            self.push(Purpose::OutsidePower, vec![power]);
        }
    }
}
