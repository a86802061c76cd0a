//! Values of the symbols of one link: constants of its row, and its motion.

use super::columns::{Column, TorqueUnit};
use super::functions::{Functions, Kind, Motion};
use crate::mechanics::BodySymbols;
use crate::mechanics::expression::SymbolId;
use crate::program::ValueId;
use crate::program::entry_list::EntryList;
use crate::program::friction::Law;
use crate::scene::FrictionPlace;

impl Functions<'_> {
    /// Values of the symbols in the torques of a link but for friction that is not viscous.
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

    /// The torque of friction that is not viscous, at a place.
    pub(super) fn known_braking(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        unit: TorqueUnit,
        place: FrictionPlace,
    ) -> (SymbolId, ValueId) {
        let [coulomb, quadratic, air] = unit.laws();
        let (law, rate, suffix) = match place {
            FrictionPlace::Joint => {
                let law = Law {
                    coulomb: self.column(list, kind, coulomb),
                    quadratic: self.column(list, kind, quadratic),
                    width: self.column(list, kind, Column::FrictionWidth),
                };
                (law, Motion::JointRate, "_joint")
            }
            FrictionPlace::Ground => {
                let law = Law {
                    coulomb: list.lowering.builder.integer(0),
                    quadratic: self.column(list, kind, air),
                    width: self.column(list, kind, Column::DragWidth),
                };
                (law, Motion::Omega, "_ground")
            }
        };
        let rate = self.motion(list, rate);
        let torque = list.lowering.builder.braking_torque(&law, rate, suffix);
        (self.forces.symbols.braking[place as usize], torque)
    }

    /// Values of the symbols of a link as a body, whose children's pivot is in these columns;
    /// torques in N m.
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
        for place in FrictionPlace::ALL {
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
