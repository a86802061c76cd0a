//! Energies by scale in a tree in loops: the functions of one link, and their constants.

use super::columns::Column;
use super::deficit::{Deficit, Rest};
use super::equations::{Elimination, ReducedLink, Response};
use super::functions::{Functions, Kind, Motion};
use crate::functions::{Argument, Purpose, ScaleFunction};
use crate::mechanics::expression::{Expr, SymbolId};
use crate::mechanics::{LinkBalance, LinkScales, LinkSymbols};
use crate::program::ValueId;
use crate::program::entries::EntryList;
use crate::program::lower::Lowering;
use crate::program::pair::Pair;
use crate::scene::{Layout, Scene};

impl EntryList<'_, '_> {
    /// The entry points of energies by scale.
    pub(super) fn scale_functions(
        &mut self,
        functions: &Functions<'_>,
        link: &LinkSymbols,
        scales: &LinkScales,
    ) {
        for function in ScaleFunction::ALL {
            let exprs = match function {
                ScaleFunction::Torques => scales.torques.as_slice(),
                ScaleFunction::Velocity => &scales.velocity,
                ScaleFunction::Moment => &scales.moment,
                ScaleFunction::Energy => std::slice::from_ref(&scales.energy),
                ScaleFunction::Slope => std::slice::from_ref(&scales.angle_slope),
                ScaleFunction::Inertial => std::slice::from_ref(&scales.inertial),
                ScaleFunction::Factor | ScaleFunction::Eliminate | ScaleFunction::Flow => &[],
            };
            let outputs = match function {
                ScaleFunction::Factor => functions.factor(self),
                ScaleFunction::Eliminate => functions.eliminate(self, link, scales),
                ScaleFunction::Flow => functions.flow(self, link, scales),
                ScaleFunction::Torques => {
                    let torques = functions.derived(self, link, scales, function, exprs);
                    functions.with_braking(self, torques)
                }
                _ => functions.derived(self, link, scales, function, exprs),
            };
            debug_assert_eq!(outputs.len(), function.results());
            self.push(Purpose::Scale(function), outputs);
        }
    }
}

impl Functions<'_> {
    /// Derived expressions at the constants and the motion of a link, and at what the
    /// function is given.
    fn derived(
        &self,
        list: &mut EntryList<'_, '_>,
        link: &LinkSymbols,
        scales: &LinkScales,
        function: ScaleFunction,
        exprs: &[Expr],
    ) -> Vec<ValueId> {
        let known = self.known(list, link, scales, function);
        let exprs = exprs.iter();
        exprs
            .map(|expr| list.lowering.at_values(expr, &known))
            .collect()
    }

    /// Torques of friction and drag with those that are not viscous, in N m.
    fn with_braking(&self, list: &mut EntryList<'_, '_>, torques: Vec<ValueId>) -> Vec<ValueId> {
        let per_torque = self.column(list, Kind::Any, Column::PerTorque);
        let laws = [
            self.joint_law(list, Kind::Any),
            self.ground_law(list, Kind::Any),
        ];
        let rates = [Motion::JointRate, Motion::Omega].map(|rate| self.motion(list, rate));
        let builder = &mut list.lowering.builder;
        let mut torques = torques;
        // Behind the strain and the torque of the spring.
        for ((torque, law), rate) in torques.iter_mut().skip(2).zip(laws).zip(rates) {
            let braking = builder.braking_torque(&law, rate, "");
            if !builder.is(braking, 0) {
                let braking = builder.div(braking, per_torque);
                *torque = builder.add(*torque, braking);
            }
        }
        torques
    }

    fn known(
        &self,
        list: &mut EntryList<'_, '_>,
        link: &LinkSymbols,
        scales: &LinkScales,
        function: ScaleFunction,
    ) -> Vec<(SymbolId, ValueId)> {
        let symbols = &scales.symbols;
        let constants = [
            (link.body[0], Column::BodyMass),
            (link.body[1], Column::BodyInertia),
            (link.com[0], Column::ComAlong),
            (link.com[1], Column::ComAcross),
            (link.place[0], Column::PlaceAlong),
            (link.place[1], Column::PlaceAcross),
            (symbols.joint[0], Column::Stiffness),
            (symbols.joint[1], Column::Rest),
            (symbols.joint[2], Column::PivotFriction),
            (symbols.joint[3], Column::GroundDrag),
            (symbols.gravity, Column::Gravity),
            (symbols.carried_moment[0], Column::CarriedMoment),
            (symbols.carried_moment[1], Column::LateralCarriedMoment),
        ];
        let mut known: Vec<(SymbolId, ValueId)> = constants
            .into_iter()
            .map(|(symbol, column)| (symbol, self.column(list, Kind::Any, column)))
            .collect();
        let motion = [
            (link.direction[0], Motion::Cosine),
            (link.direction[1], Motion::Sine),
            (link.omega, Motion::Omega),
            (symbols.relative[0], Motion::JointAngle),
            (symbols.relative[1], Motion::JointRate),
        ];
        for (symbol, element) in motion {
            known.push((symbol, self.motion(list, element)));
        }
        let given: Vec<SymbolId> = match function {
            ScaleFunction::Velocity => symbols.pivot_velocity.to_vec(),
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
            ScaleFunction::Inertial => symbols.root_acceleration.to_vec(),
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

    /// The link at rest, in the units of the recursion, under a torque in N m.
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

    fn eliminate(
        &self,
        list: &mut EntryList<'_, '_>,
        link: &LinkSymbols,
        scales: &LinkScales,
    ) -> Vec<ValueId> {
        let function = ScaleFunction::Eliminate;
        let mut at = |index| given_value(list, function, index);
        let gain = [at(0), at(1)];
        let inverse = at(2);
        let (moment, rate) = ([at(3), at(4)], at(5));
        let below = [at(6), at(7)];
        let mut known = self.known(list, link, scales, function);
        let symbols = &scales.symbols;
        known.extend(symbols.moment.into_iter().zip(moment));
        known.push((symbols.parts[2], rate));
        let slope = list.lowering.at_values(&scales.rate_slope, &known);
        let (link, place) = self.resting(list, Some(slope));
        let builder = &mut list.lowering.builder;
        let y = builder.turn(place, link.direction);
        let pull = builder.dot(y, below);
        let torque = builder.sub(link.torque, pull);
        let part = builder.scale_pair(torque, gain);
        let [x, y] = builder.add_pairs(below, part);
        let reduced = builder.mul(torque, inverse);
        vec![x, y, builder.neg(reduced)]
    }

    fn flow(
        &self,
        list: &mut EntryList<'_, '_>,
        link: &LinkSymbols,
        scales: &LinkScales,
    ) -> Vec<ValueId> {
        let function = ScaleFunction::Flow;
        let mut at = |index| given_value(list, function, index);
        let elimination = Elimination {
            gain: [at(0), at(1)],
            offset: at(2),
        };
        let (pivot, shift) = ([at(3), at(4)], [at(5), at(6)]);
        let mut known = self.known(list, link, scales, function);
        let (link, place) = self.resting(list, None);
        let builder = &mut list.lowering.builder;
        let [tangential, flow] = link.accelerate(builder, &elimination, pivot);
        let [x, y] = link.gravity_at(builder, place, pivot, tangential);
        let symbols = &scales.symbols;
        known.extend(symbols.pivot_shift.into_iter().zip(shift));
        known.push((symbols.flow, flow));
        let shift = scales.shift.iter();
        let shift = shift.map(|expr| list.lowering.at_values(expr, &known));
        [flow, x, y].into_iter().chain(shift).collect()
    }
}

fn given_value(list: &mut EntryList<'_, '_>, function: ScaleFunction, index: usize) -> ValueId {
    let builder = &mut list.lowering.builder;
    builder.input(Argument::Given(function), index)
}

impl Lowering<'_> {
    /// Fills the columns that energies by scale read, in a tree by generations.
    pub(super) fn scale_columns(
        &mut self,
        scene: &Scene,
        balance: &LinkBalance,
        rows: &mut [[ValueId; Column::ALL.len()]],
    ) {
        let Layout::Generations { branching, .. } = scene.layout else {
            return;
        };
        let children = super::children(scene);
        let copies = self.builder.integer(branching as i64);
        let zero = self.builder.integer(0);
        let gravity = self.value_of(&scene.gravity);
        let mut masses = vec![zero; scene.links.len()];
        // From the leaves to the root.
        for (index, link) in scene.links.iter().enumerate().rev() {
            let child = children[index].first().map(|&child| {
                let place = self.values_of(&scene.links[child].pivot);
                (place, self.builder.mul(copies, masses[child]))
            });
            let carried = self.composite(scene, index, balance, child.as_slice());
            masses[index] = carried[3];
            let place = child.map_or([zero; 2], |(place, _)| place);
            let com = self.values_of(&link.com);
            let values = [
                (Column::BodyMass, self.value_of(&link.mass)),
                (Column::BodyInertia, self.value_of(&link.inertia)),
                (Column::ComAlong, com[0]),
                (Column::ComAcross, com[1]),
                (Column::PlaceAlong, place[0]),
                (Column::PlaceAcross, place[1]),
                (Column::CarriedMoment, carried[1]),
                (Column::LateralCarriedMoment, carried[2]),
                (Column::Gravity, gravity),
                (Column::Stiffness, self.value_of(&link.passive.spring)),
                (Column::PivotFriction, self.value_of(&link.passive.friction)),
                (Column::GroundDrag, self.value_of(&link.passive.drag)),
            ];
            for (column, value) in values {
                rows[link.orbit.0][column as usize] = value;
            }
        }
    }
}
