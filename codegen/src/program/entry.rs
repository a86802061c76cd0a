//! Entry points: functions with values of the program as their outputs.

use super::ValueId;
use crate::functions::{Argument, Naming, Purpose, ResultShape, Signature};
use crate::mechanics::Mechanics;
use crate::scene::{Coordinate, CoordinateKind, Scene};

/// An entry point: a function that consists of the operations which its outputs need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Function name.
    pub name: String,
    /// Purpose of the function.
    pub purpose: Purpose,
    /// Arguments in order.
    pub arguments: Vec<Argument>,
    /// Output values.
    pub outputs: Vec<ValueId>,
    /// Type in which the outputs are returned.
    pub shape: ResultShape,
}

impl Entry {
    /// Creates the entry point with this signature and these outputs.
    pub(super) fn new(signature: Signature, purpose: Purpose, outputs: Vec<ValueId>) -> Self {
        let Signature {
            name,
            arguments,
            shape,
        } = signature;
        Self {
            name,
            purpose,
            arguments,
            outputs,
            shape,
        }
    }
}

impl Naming {
    pub(crate) fn of(scene: &Scene, mechanics: &Mechanics) -> Self {
        let coordinates = &mechanics.coordinates;
        let is_difference = |c: &&Coordinate| matches!(c.kind, CoordinateKind::Difference { .. });
        let several = coordinates.iter().filter(is_difference).count() > 1;
        let place = |coordinate: usize| match several {
            true => format!("_{}", coordinates[coordinate].name),
            false => String::new(),
        };
        let transfers = mechanics.transfers.iter();
        let prescribed = scene.prescribed.iter();
        let observables = mechanics.observables.list.iter();
        let transverse = mechanics.transverse.iter().flat_map(|all| &all.sectors);
        Self {
            driven: mechanics.drive.is_some(),
            damped_by_angle: scene
                .translational
                .iter()
                .any(|own| !own.friction.is_zero()),
            links: scene.links.len(),
            parameters: scene.parameters.len(),
            sectors: mechanics
                .sectors
                .as_ref()
                .map_or(0, |all| all.sectors.len()),
            places: transfers
                .map(|transfer| place(transfer.coordinate))
                .collect(),
            prescribed: prescribed
                .map(|set| (set.name.clone(), set.links.len()))
                .collect(),
            observables: observables.map(|o| (o.name.clone(), o.symmetric)).collect(),
            transverse: transverse.map(|of| of.sector.name.clone()).collect(),
        }
    }
}
