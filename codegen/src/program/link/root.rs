//! Apparent gravity and torque at the root of a tree in loops.

use super::strips::Table;
use crate::functions::{Argument, Purpose};
use crate::mechanics::{DriveTerms, Mechanics};
use crate::program::entry_list::EntryList;
use crate::program::lower::Environment;

impl EntryList<'_, '_> {
    /// Adds the apparent gravity at the root's pivot and, if there is a drive, the torque on the
    /// root, in reduced units.
    pub(super) fn root(&mut self, mechanics: &Mechanics, table: &Table) {
        let units = &table.units;
        let mut environment = Environment::new(&mechanics.absolute, Argument::Theta, None, None);
        let drive: Option<&DriveTerms> = mechanics.drive.as_ref();
        let builder = &mut self.lowering.builder;
        let zero = builder.integer(0);
        let mut outputs = vec![zero, table.root_gravity];
        self.push(Purpose::RootGravity, outputs.clone());
        let Some(drive) = drive else { return };
        outputs = vec![zero; 3];
        for motion in &drive.pivot {
            let inner = &motion.inner_acceleration;
            let acceleration = self.lowering.expr(&mut environment, inner);
            let builder = &mut self.lowering.builder;
            let reduced = builder.mul(units.per_length, acceleration);
            outputs[usize::from(motion.name == "y")] = builder.neg(reduced);
        }
        if let Some(torque) = drive.torque {
            let torque = self.lowering.temporal(&mut environment, torque);
            outputs[2] = self.lowering.builder.mul(table.per_torque(), torque);
        }
        self.push(Purpose::RootDrive, outputs);
    }
}
