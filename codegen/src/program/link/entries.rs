//! The equations of one link as entry points of their own, for trees in loops.

use super::columns::Column;
use super::functions::Functions;
use super::strips::LoopTree;
use crate::functions::{Argument, LinkFunction, Purpose, ResultShape};
use crate::mechanics::Mechanics;
use crate::program::entries::EntryList;
use crate::program::{Entry, Op, ValueId};
use crate::scene::Scene;

impl EntryList<'_, '_> {
    /// The entry points of a tree in loops, and its constants.
    pub(in crate::program) fn link_functions(
        &mut self,
        scene: &Scene,
        mechanics: &Mechanics,
    ) -> LoopTree {
        let Some(balance) = &mechanics.link else {
            unreachable!("trees in loops come with the balance of a link");
        };
        let table = self.lowering.strip_table(scene, balance);
        let joints = scene
            .links
            .iter()
            .any(|link| link.passive.has_joint_torque());
        let functions = Functions {
            table: &table,
            joints,
            forced: scene.requests.forces,
            prescribed: !scene.prescribed.is_empty(),
            drive_torque: mechanics
                .drive
                .as_ref()
                .is_some_and(|drive| drive.torque.is_some()),
        };
        for function in LinkFunction::ALL {
            let outputs = functions.of(self, function);
            let purpose = Purpose::Link(function);
            let mut signature = self.naming.signature(purpose);
            // The response stands before the elimination, the acceleration before the rest.
            signature.shape = match function {
                LinkFunction::Inner => ResultShape::Split(outputs.len() - 3),
                LinkFunction::Accelerate => ResultShape::Split(1),
                LinkFunction::AccelerateLeaf => ResultShape::Scalar,
                _ => ResultShape::Vector,
            };
            self.entries.push(Entry::new(signature, purpose, outputs));
        }
        if let Some(scales) = &mechanics.scales {
            self.scale_functions(&functions, &balance.symbols, scales);
        }
        self.root(mechanics, &table);
        if let Some(drive) = &mechanics.drive {
            self.drive(mechanics, drive);
        }
        let columns = self.columns_read(functions.drive_torque);
        self.lowering.strips(scene, &table, columns)
    }

    /// The columns that the functions read; these are numbered anew.
    fn columns_read(&mut self, drive_torque: bool) -> Vec<Column> {
        let outputs = self.entries.iter().flat_map(|entry| &entry.outputs);
        let outputs: Vec<ValueId> = outputs.copied().collect();
        let builder = &mut self.lowering.builder;
        let needed = builder.needed(&outputs);
        let is_read = |column: &Column| {
            let wanted = Op::Input(Argument::Constants, *column as usize);
            let last = drive_torque && *column == Column::DriveTorque;
            last || needed.iter().any(|&id| *builder.op(id) == wanted)
        };
        let columns: Vec<Column> = Column::ALL.into_iter().filter(is_read).collect();
        for definition in &mut builder.definitions {
            if let Op::Input(Argument::Constants, index) = &mut definition.op {
                let place = columns.iter().position(|&column| column as usize == *index);
                *index = place.unwrap_or(usize::MAX);
            }
        }
        columns
    }
}
