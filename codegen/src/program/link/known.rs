//! Values of the symbols of one link: constants from its row, and its motion.

use super::columns::{Column, TorqueUnit};
use super::functions::{Functions, Kind, Motion};
use crate::mechanics::BodySymbols;
use crate::mechanics::expression::SymbolId;
use crate::program::ValueId;
use crate::program::entry_list::EntryList;
use crate::scene::FrictionContact;

impl Functions<'_> {
    /// Returns the values of the symbols in the torques of a link, except friction that is not
    /// viscous.
    pub(super) fn known_forces(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        unit: TorqueUnit,
    ) -> Vec<(SymbolId, ValueId)> {
        let symbols = &self.forces.symbols;
        let [spring, friction, drag] = unit.viscous();
        let columns = [spring, Column::Rest, friction, drag];
        let constants = symbols.constants.into_iter().zip(columns);
        let mut known: Vec<(SymbolId, ValueId)> = constants
            .map(|(symbol, column)| (symbol, self.column(list, kind, column)))
            .collect();
        let motion = [Motion::JointAngle, Motion::JointRate];
        for (symbol, element) in symbols.relative.into_iter().zip(motion) {
            known.push((symbol, self.motion(list, element)));
        }
        known.push((self.link.omega, self.motion(list, Motion::Omega)));
        known
    }

    /// Returns the torque of friction that is not viscous, in the joint or against the ground.
    pub(super) fn known_braking(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        unit: TorqueUnit,
        place: FrictionContact,
    ) -> (SymbolId, ValueId) {
        let law = unit.law(place).map(|column| match column {
            Some(column) => self.column(list, kind, *column),
            None => list.lowering.builder.integer(0),
        });
        let (rate, suffix) = match place {
            FrictionContact::Joint => (Motion::JointRate, "_joint"),
            FrictionContact::Ground => (Motion::Omega, "_ground"),
        };
        let rate = self.motion(list, rate);
        let torque = list.lowering.builder.braking_torque(&law, rate, suffix);
        (self.forces.symbols.braking[place as usize], torque)
    }

    /// Returns the values of the symbols of a link's body; the given columns contain the position
    /// of its children's pivot. Torques are in N m.
    pub(super) fn known_body(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        symbols: &BodySymbols,
        place: [Column; 2],
    ) -> Vec<(SymbolId, ValueId)> {
        let link = self.link;
        let unit = TorqueUnit::NewtonMetre;
        let mut known = self.known_forces(list, kind, unit);
        for place in FrictionContact::ALL {
            known.push(self.known_braking(list, kind, unit, place));
        }
        let constants = [
            (link.body[0], Column::BodyMass),
            (link.body[1], Column::BodyInertia),
            (link.com[0], Column::ComAlong),
            (link.com[1], Column::ComAcross),
            (link.place[0], place[0]),
            (link.place[1], place[1]),
            (symbols.gravity, Column::Gravity),
            (symbols.carried_moment[0], Column::CarriedMoment),
            (symbols.carried_moment[1], Column::LateralCarriedMoment),
            (symbols.weight_moment[0], Column::WeightMoment),
            (symbols.weight_moment[1], Column::LateralWeightMoment),
        ];
        for (symbol, column) in constants {
            known.push((symbol, self.column(list, kind, column)));
        }
        let motion = [
            (link.direction[0], Motion::Cosine),
            (link.direction[1], Motion::Sine),
        ];
        for (symbol, element) in motion {
            known.push((symbol, self.motion(list, element)));
        }
        known
    }
}
