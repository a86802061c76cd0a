//! Energies, powers and positions of a tree in loops: the functions of one link, and their
//! constants.

use super::columns::Column;
use super::functions::{Functions, Kind, Motion};
use super::reduced_units::Units;
use crate::functions::{Argument, BodyFunction, Purpose};
use crate::mechanics::expression::SymbolId;
use crate::mechanics::{BodySymbols, LinkBalance, LinkBody};
use crate::program::ValueId;
use crate::program::entry_list::EntryList;
use crate::program::lower::Lowering;
use crate::scene::{FrictionContact, Scene};

impl EntryList<'_, '_> {
    /// Adds the entry points of energies, powers and positions.
    pub(super) fn body_functions(&mut self, functions: &Functions<'_>, body: &LinkBody) {
        for &function in &body.functions {
            let known = functions.known_of(self, &body.symbols, function);
            let results = body.results(function).iter();
            let outputs: Vec<ValueId> = results
                .map(|expr| self.lowering.at_values(expr, &known))
                .collect();
            debug_assert_eq!(outputs.len(), function.results());
            self.push(Purpose::Body(function), outputs);
        }
    }
}

impl Functions<'_> {
    fn known_of(
        &self,
        list: &mut EntryList<'_, '_>,
        symbols: &BodySymbols,
        function: BodyFunction,
    ) -> Vec<(SymbolId, ValueId)> {
        // The position of a pivot on its parent is in the child's row of constants.
        let kind = match function {
            BodyFunction::PivotVelocity => Kind::Child,
            BodyFunction::KineticEnergy
            | BodyFunction::PotentialEnergy
            | BodyFunction::FrictionLoss
            | BodyFunction::DrivePower
            | BodyFunction::OutsidePower
            | BodyFunction::Point
            | BodyFunction::PointVelocity
            | BodyFunction::PointTorque => Kind::Any,
        };
        let place = [Column::PivotAlong, Column::PivotAcross];
        let mut known = self.known_body(list, kind, symbols, place);
        if function == BodyFunction::OutsidePower {
            let torque = self.motion(list, Motion::OutsideTorque);
            known.push((symbols.outside_torque, torque));
        }
        let given = match function {
            BodyFunction::PivotVelocity | BodyFunction::KineticEnergy => {
                symbols.pivot_velocity.to_vec()
            }
            BodyFunction::DrivePower => {
                let [x, y] = symbols.root_acceleration;
                vec![x, y, symbols.root_torque]
            }
            BodyFunction::Point | BodyFunction::PointVelocity => symbols.point.to_vec(),
            BodyFunction::PointTorque => [symbols.point, symbols.force].concat(),
            BodyFunction::PotentialEnergy
            | BodyFunction::FrictionLoss
            | BodyFunction::OutsidePower => Vec::new(),
        };
        let argument = Argument::Given(function.given());
        for (index, symbol) in given.into_iter().enumerate() {
            known.push((symbol, list.lowering.builder.input(argument, index)));
        }
        known
    }
}

impl Lowering<'_> {
    /// Fills the columns of constants that energies and powers read.
    pub(super) fn body_columns(
        &mut self,
        scene: &Scene,
        balance: &LinkBalance,
        body: &LinkBody,
        units: &Units,
        rows: &mut [[ValueId; Column::ALL.len()]],
    ) {
        let children = super::children(scene);
        let copies = self.builder.integer(super::copies(scene));
        let zero = self.builder.integer(0);
        let gravity = self.value_of(&scene.gravity);
        let mut masses = vec![zero; scene.orbits.len()];
        // From the leaves to the root: orbits are in the order of their first links.
        for (number, orbit) in scene.orbits.iter().enumerate().rev() {
            let index = orbit.links[0].0;
            let link = &scene.links[index];
            let hanging = children[index].iter().map(|&child| {
                let child = &scene.links[child];
                let place = self.values_of(&child.pivot);
                (place, self.builder.mul(copies, masses[child.orbit.0]))
            });
            let hanging: Vec<([ValueId; 2], ValueId)> = hanging.collect();
            let carried = self.composite(scene, index, balance, &hanging);
            masses[number] = carried[3];
            let first = hanging.first();
            let place = first.map_or([zero; 2], |&(place, _)| place);
            let com = self.values_of(&link.com);
            let pivot = self.values_of(&link.pivot);
            let weight = self.weight_moment(body, gravity, [carried[1], carried[2]]);
            let passive = &units.links[number].passive;
            let [joint, ground] = FrictionContact::ALL.map(|place| passive.law(place));
            let [body_mass, body_inertia] =
                [&link.mass, &link.inertia].map(|quantity| self.value_of(quantity));
            for column in Column::ALL {
                let value = &mut rows[number][column as usize];
                *value = match column {
                    Column::BodyMass => body_mass,
                    Column::BodyInertia => body_inertia,
                    Column::ComAlong => com[0],
                    Column::ComAcross => com[1],
                    Column::PlaceAlong => place[0],
                    Column::PlaceAcross => place[1],
                    Column::PivotAlong => pivot[0],
                    Column::PivotAcross => pivot[1],
                    Column::CarriedMoment => carried[1],
                    Column::LateralCarriedMoment => carried[2],
                    Column::WeightMoment => weight[0],
                    Column::LateralWeightMoment => weight[1],
                    Column::Gravity => gravity,
                    Column::Stiffness => passive.spring,
                    Column::PivotFriction => passive.friction,
                    Column::GroundDrag => passive.drag,
                    Column::PivotCoulomb => joint.coulomb,
                    Column::PivotExcess => joint.excess,
                    Column::PivotQuadratic => joint.quadratic,
                    Column::GroundQuadratic => ground.quadratic,
                    // These constants belong to the equations of motion only.
                    Column::Inertia
                    | Column::Moment
                    | Column::LateralMoment
                    | Column::Mass
                    | Column::Length
                    | Column::InverseLength
                    | Column::GainAlong
                    | Column::GainAcross
                    | Column::InverseInertia
                    | Column::Along
                    | Column::Across
                    | Column::Friction
                    | Column::Drag
                    | Column::Spring
                    | Column::Rest
                    | Column::Coulomb
                    | Column::QuadraticFriction
                    | Column::StaticExcess
                    | Column::StribeckRate
                    | Column::FrictionWidth
                    | Column::QuadraticDrag
                    | Column::DragWidth
                    | Column::PerTorque
                    | Column::TorqueUnit
                    | Column::DriveTorque => *value,
                };
            }
        }
    }

    /// Computes the weight of everything that a link carries times its lever, along and across the
    /// link.
    fn weight_moment(
        &mut self,
        body: &LinkBody,
        gravity: ValueId,
        carried: [ValueId; 2],
    ) -> [ValueId; 2] {
        let symbols = &body.symbols;
        let known = [
            (symbols.gravity, gravity),
            (symbols.carried_moment[0], carried[0]),
            (symbols.carried_moment[1], carried[1]),
        ];
        let weight = body.weight_moment.each_ref();
        weight.map(|moment| self.at_values(moment, &known))
    }
}
