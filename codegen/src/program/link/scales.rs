//! Functions of one link for energies by scale (generation of the branching), in a tree in loops.

use super::columns::Column;
use super::deficit::{Deficit, Rest};
use super::equations::{Elimination, ReducedLink, Response};
use super::functions::{Functions, Kind, Motion};
use crate::functions::{Argument, Purpose, ScaleFunction};
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{LinkBody, LinkScales};
use crate::program::ValueId;
use crate::program::entry_list::EntryList;
use crate::program::pair::Pair;

impl EntryList<'_, '_> {
    /// Adds the entry points of energies by scale.
    pub(super) fn scale_functions(
        &mut self,
        functions: &Functions<'_>,
        body: &LinkBody,
        scales: &LinkScales,
    ) {
        let all = ScaleParts {
            functions,
            body,
            scales,
        };
        for function in ScaleFunction::ALL {
            let outputs = all.outputs(self, function);
            debug_assert_eq!(outputs.len(), function.results());
            self.push(Purpose::Scale(function), outputs);
        }
    }
}

/// Derived formulas from which the functions for energies by scale are built.
struct ScaleParts<'t> {
    functions: &'t Functions<'t>,
    body: &'t LinkBody,
    scales: &'t LinkScales,
}

impl ScaleParts<'_> {
    fn outputs(&self, list: &mut EntryList<'_, '_>, function: ScaleFunction) -> Vec<ValueId> {
        let (scales, torques) = (self.scales, self.functions.forces.all());
        let exprs: Vec<&Expr> = match function {
            ScaleFunction::Torques => torques.to_vec(),
            ScaleFunction::Velocity => self.body.velocity.iter().collect(),
            ScaleFunction::Moment => scales.moment.iter().collect(),
            ScaleFunction::Energy => vec![&scales.energy],
            ScaleFunction::Slope => vec![&scales.angle_slope],
            ScaleFunction::Inertial => vec![&self.body.inertial],
            ScaleFunction::Factor => return self.functions.factor(list),
            ScaleFunction::Eliminate => return self.eliminate(list),
            ScaleFunction::Flow => return self.flow(list),
        };
        let known = self.known(list, function);
        let exprs = exprs.into_iter();
        exprs
            .map(|expr| list.lowering.at_values(expr, &known))
            .collect()
    }

    /// Returns the values of a link's symbols and of the function's arguments.
    fn known(
        &self,
        list: &mut EntryList<'_, '_>,
        function: ScaleFunction,
    ) -> Vec<(SymbolId, ValueId)> {
        let (symbols, body) = (&self.scales.symbols, &self.body.symbols);
        let place = [Column::PlaceAlong, Column::PlaceAcross];
        let mut known = self.functions.known_body(list, Kind::Any, body, place);
        let given: Vec<SymbolId> = match function {
            ScaleFunction::Velocity => body.pivot_velocity.to_vec(),
            ScaleFunction::Moment => [symbols.velocity, symbols.carried].concat(),
            ScaleFunction::Energy => {
                let parts = symbols.parts.iter().chain([&symbols.means]);
                parts.copied().collect()
            }
            ScaleFunction::Slope => vec![
                symbols.moment[0],
                symbols.moment[1],
                symbols.parts[3],
                symbols.parts[4],
                symbols.spring_part,
                symbols.means,
                symbols.shift_moment[0],
                symbols.shift_moment[1],
            ],
            ScaleFunction::Inertial => body.root_acceleration.to_vec(),
            ScaleFunction::Torques
            | ScaleFunction::Factor
            | ScaleFunction::Eliminate
            | ScaleFunction::Flow => Vec::new(),
        };
        for (index, symbol) in given.into_iter().enumerate() {
            known.push((symbol, given_value(list, function, index)));
        }
        known
    }

    fn eliminate(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let function = ScaleFunction::Eliminate;
        let mut at = |index| given_value(list, function, index);
        let gain = [at(0), at(1)];
        let inverse = at(2);
        let (moment, rate) = ([at(3), at(4)], at(5));
        let below = [at(6), at(7)];
        let mut known = self.known(list, function);
        let symbols = &self.scales.symbols;
        known.extend(symbols.moment.into_iter().zip(moment));
        known.push((symbols.parts[2], rate));
        let slope = list.lowering.at_values(&self.scales.rate_slope, &known);
        let (link, place) = self.functions.resting(list, Some(slope));
        let builder = &mut list.lowering.builder;
        let y = builder.complex_product(place, link.direction);
        let pull = builder.dot(y, below);
        let torque = builder.sub(link.torque, pull);
        let part = builder.scale_pair(torque, gain);
        let [x, y] = builder.add_pairs(below, part);
        let reduced = builder.mul(torque, inverse);
        vec![x, y, builder.neg(reduced)]
    }

    fn flow(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let function = ScaleFunction::Flow;
        let mut at = |index| given_value(list, function, index);
        let elimination = Elimination {
            gain: [at(0), at(1)],
            offset: at(2),
        };
        let (pivot, shift) = ([at(3), at(4)], [at(5), at(6)]);
        let mut known = self.known(list, function);
        let (link, place) = self.functions.resting(list, None);
        let builder = &mut list.lowering.builder;
        let [tangential, flow] = link.accelerate(builder, &elimination, pivot);
        let [x, y] = link.gravity_at(builder, place, pivot, tangential);
        let symbols = &self.scales.symbols;
        known.extend(symbols.pivot_shift.into_iter().zip(shift));
        known.push((symbols.flow, flow));
        let shift = self.scales.shift.iter();
        let shift = shift.map(|expr| list.lowering.at_values(expr, &known));
        [flow, x, y].into_iter().chain(shift).collect()
    }
}

impl Functions<'_> {
    /// Returns the link at rest under a torque in N m, in the units of the recursion.
    fn resting(
        &self,
        list: &mut EntryList<'_, '_>,
        torque: Option<ValueId>,
    ) -> (ReducedLink, Pair) {
        let direction = [Motion::Cosine, Motion::Sine].map(|part| self.motion(list, part));
        let mut at = |column| self.column(list, Kind::Any, column);
        let moment = [at(Column::Moment), at(Column::LateralMoment)];
        let (inertia, mass) = (at(Column::Inertia), at(Column::Mass));
        let (length, inverse_length) = (at(Column::Length), at(Column::InverseLength));
        let place = [at(Column::Along), at(Column::Across)];
        let per_torque = at(Column::PerTorque);
        let builder = &mut list.lowering.builder;
        let zero = builder.integer(0);
        let torque = match torque {
            Some(torque) => {
                let unit = builder.mul(inverse_length, per_torque);
                builder.mul(unit, torque)
            }
            None => zero,
        };
        let link = ReducedLink {
            moment,
            inertia,
            mass,
            length,
            inverse_length,
            direction,
            omega: zero,
            torque,
            suffix: String::new(),
        };
        (link, place)
    }

    fn factor(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let (link, place) = self.resting(list, None);
        let [xx, xy, yy] = [0, 1, 2].map(|index| given_value(list, ScaleFunction::Factor, index));
        let builder = &mut list.lowering.builder;
        let response = Response {
            deficit: Deficit {
                xx,
                xy,
                rest: Rest::Yy(yy),
            },
            bias_force: builder.zero_pair(),
        };
        let whole = link.attach(builder, place, &response, Some(link.body()), true);
        let (response, elimination) = link.eliminate(builder, &whole);
        let Deficit { xx, xy, .. } = response.deficit;
        let yy = response.deficit.yy(builder);
        let one = builder.integer(1);
        let inverse = builder.div(one, whole.inertia);
        let [gain_x, gain_y] = elimination.gain;
        vec![xx, xy, yy, gain_x, gain_y, inverse]
    }
}

fn given_value(list: &mut EntryList<'_, '_>, function: ScaleFunction, index: usize) -> ValueId {
    let builder = &mut list.lowering.builder;
    builder.input(Argument::Given(function.given()), index)
}
