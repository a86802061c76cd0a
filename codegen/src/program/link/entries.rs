//! Equations of one link as entry points, for trees in loops.

use super::columns::Column;
use super::functions::Functions;
use super::loop_tree::LoopTree;
use crate::functions::{Argument, LinkFunction, Purpose, ResultShape};
use crate::mechanics::Mechanics;
use crate::program::entry_list::EntryList;
use crate::program::{Entry, Op, ValueId};
use crate::scene::Scene;

impl EntryList<'_, '_> {
    /// Adds the entry points of a tree in loops; returns its constants.
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
        let Some(forces) = &mechanics.joint_forces else {
            unreachable!("trees in loops come with the torques of a link");
        };
        let functions = Functions {
            table: &table,
            rows: Argument::Constants,
            link: &balance.symbols,
            forces,
            joints,
            forced: super::has_outside_torques(scene),
            prescribed: super::has_prescribed_links(scene),
            drive_torque: mechanics
                .drive
                .as_ref()
                .is_some_and(|drive| drive.torque.is_some()),
            differentiated: super::has_pullback(scene),
        };
        for function in LinkFunction::ALL {
            let outputs = functions.of(self, function);
            let purpose = Purpose::Link(function);
            let mut signature = self.naming.signature(purpose);
            // Of two results the response comes before the elimination, and the acceleration before
            // other values.
            signature.shape = match function {
                LinkFunction::Inner => ResultShape::Split(outputs.len() - 3),
                LinkFunction::Accelerate => ResultShape::Split(1),
                LinkFunction::AccelerateLeaf => ResultShape::Scalar,
                LinkFunction::Leaf | LinkFunction::Attach | LinkFunction::Pivot => {
                    ResultShape::Vector
                }
            };
            self.entries.push(Entry::new(signature, purpose, outputs));
        }
        if let Some(body) = &mechanics.body {
            if let Some(scales) = &mechanics.scales {
                self.scale_functions(&functions, body, scales);
            }
            let rows = Argument::Body;
            self.body_functions(&Functions { rows, ..functions }, body);
        }
        self.root(mechanics, &table);
        if let Some(drive) = &mechanics.drive {
            self.drive(mechanics, drive);
            self.drive_pullback(scene);
        }
        let torque = functions.drive_torque.then_some(Column::DriveTorque);
        let columns = self.columns_read(Argument::Constants, torque);
        let body_columns = self.columns_read(Argument::Body, None);
        self.lowering.strips(scene, &table, [columns, body_columns])
    }

    /// Returns the columns that the functions read, and renumbers their uses. If given, `last` is
    /// included and comes last.
    fn columns_read(&mut self, rows: Argument, last: Option<Column>) -> Vec<Column> {
        let outputs = self.entries.iter().flat_map(|entry| &entry.outputs);
        let outputs: Vec<ValueId> = outputs.copied().collect();
        let builder = &mut self.lowering.builder;
        let needed = builder.needed(&outputs);
        let is_read = |column: &Column| {
            let wanted = Op::Input(rows, *column as usize);
            last == Some(*column) || needed.iter().any(|&id| *builder.op(id) == wanted)
        };
        let columns: Vec<Column> = Column::ALL.into_iter().filter(is_read).collect();
        for definition in &mut builder.definitions {
            match &mut definition.op {
                Op::Input(argument, index) if *argument == rows => {
                    let place = columns.iter().position(|&column| column as usize == *index);
                    *index = place.unwrap_or(usize::MAX);
                }
                _ => {}
            }
        }
        columns
    }
}
