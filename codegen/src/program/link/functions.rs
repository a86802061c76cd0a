//! Functions of one link in a tree in loops: its equations, applied to elements of arguments.

use super::columns::{Column, TorqueUnit};
use super::deficit::{Deficit, Rest};
use super::equations::{Attached, Elimination, ReducedLink, Response};
use super::strips::Table;
use crate::functions::{Argument, LinkFunction};
use crate::mechanics::{JointForces, LinkSymbols};
use crate::program::ValueId;
use crate::program::entry_list::EntryList;
use crate::program::pair::Pair;
use crate::scene::FrictionContact;

/// Links whose constants an entry point reads.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Leaf,
    Inner,
    /// A child; the motion passed to the function is that of its parent.
    Child,
    /// Any link.
    Any,
}

/// Builder of the functions of one link.
#[derive(Clone, Copy)]
pub(super) struct Functions<'t> {
    pub(super) table: &'t Table,
    /// Argument that holds the link's constants, one element per column.
    pub(super) rows: Argument,
    pub(super) link: &'t LinkSymbols,
    pub(super) forces: &'t JointForces,
    pub(super) joints: bool,
    pub(super) forced: bool,
    /// True if links may be prescribed.
    pub(super) prescribed: bool,
    pub(super) drive_torque: bool,
    /// True if derivatives of the accelerations are requested. They need the same equations without
    /// springs and friction, which therefore are elements of the row even if all rows agree.
    pub(super) differentiated: bool,
}

impl Functions<'_> {
    /// Returns a constant of the link: a number if it is the same in all rows, otherwise an element
    /// of the row.
    pub(super) fn column(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        column: Column,
    ) -> ValueId {
        let builder = &mut list.lowering.builder;
        let common = match (kind, column) {
            (Kind::Inner, Column::DriveTorque) if self.drive_torque => None,
            (Kind::Child, _) => self.table.common_of_children(builder, column),
            (Kind::Any, _) => self.table.common_of_all(builder, column),
            (Kind::Leaf, _) => self.table.common(builder, true, column),
            (Kind::Inner, _) => self.table.common(builder, false, column),
        };
        let varies = self.differentiated && column.is_passive_torque();
        match common {
            Some(number) if number.is_zero() || !varies => builder.number(number),
            Some(_) | None => builder.input(self.rows, column as usize),
        }
    }

    pub(super) fn motion(&self, list: &mut EntryList<'_, '_>, element: Motion) -> ValueId {
        list.lowering
            .builder
            .input(Argument::Motion, element as usize)
    }

    /// Returns the link in the form that the equations use; `torque` is the torque that its
    /// children's joints exert on it.
    fn link(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        torque: Option<ValueId>,
    ) -> (ReducedLink, ValueId) {
        let direction = [Motion::Cosine, Motion::Sine].map(|part| self.motion(list, part));
        let omega = self.motion(list, Motion::Omega);
        let own = match kind {
            Kind::Child => Kind::Inner,
            kind => kind,
        };
        let mut at = |column| self.column(list, own, column);
        let moment = [at(Column::Moment), at(Column::LateralMoment)];
        let (inertia, mass) = (at(Column::Inertia), at(Column::Mass));
        let (length, inverse_length) = (at(Column::Length), at(Column::InverseLength));
        let driven = at(Column::DriveTorque);
        let [joint, dragged] = self.resisting_torques(list, own);
        let outside = self.outside_torque(list, own);
        let builder = &mut list.lowering.builder;
        // The torques of the joint and of drag act against the link; those of τ, Q and the
        // children's joints act on it.
        let resisting = builder.add(joint, dragged);
        let below = torque.unwrap_or_else(|| builder.integer(0));
        let pushed = builder.add(below, driven);
        let pushed = builder.add(pushed, outside);
        let torque = builder.sub(pushed, resisting);
        let torque = builder.mul(inverse_length, torque);
        let link = ReducedLink {
            moment,
            inertia,
            mass,
            length,
            inverse_length,
            direction,
            omega,
            torque,
            suffix: String::new(),
        };
        (link, joint)
    }

    /// Returns the torques of the joint on the parent and of drag on the ground, divided by m l².
    fn resisting_torques(&self, list: &mut EntryList<'_, '_>, kind: Kind) -> [ValueId; 2] {
        let unit = TorqueUnit::Reduced;
        let JointForces {
            spring,
            friction,
            drag,
            ..
        } = self.forces;
        let mut known = self.known_forces(list, kind, unit);
        known.push(self.known_braking(list, kind, unit, FrictionContact::Joint));
        let [bent, slowed] =
            [spring, friction].map(|torque| list.lowering.at_values(torque, &known));
        let torque = list.lowering.builder.add(slowed, bent);
        let torque = list.lowering.builder.name(torque, "joint_torque");
        known.push(self.known_braking(list, kind, unit, FrictionContact::Ground));
        [torque, list.lowering.at_values(drag, &known)]
    }

    /// Returns the external torque, divided by m l².
    fn outside_torque(&self, list: &mut EntryList<'_, '_>, kind: Kind) -> ValueId {
        if !self.forced {
            return list.lowering.builder.integer(0);
        }
        let unit = self.column(list, kind, Column::PerTorque);
        let mut torque = self.motion(list, Motion::OutsideTorque);
        if self.prescribed {
            // For a prescribed link this element holds the acceleration.
            let prescribed = self.motion(list, Motion::Prescribed);
            let builder = &mut list.lowering.builder;
            let acceleration = builder.mul(prescribed, torque);
            torque = builder.sub(torque, acceleration);
        }
        list.lowering.builder.mul(unit, torque)
    }

    /// Reads a response from an argument, and the torque of joints that follows it.
    fn given(
        &self,
        list: &mut EntryList<'_, '_>,
        argument: Argument,
    ) -> (Response, Option<ValueId>) {
        let builder = &mut list.lowering.builder;
        let mut at = |index| builder.input(argument, index);
        let response = Response {
            deficit: Deficit {
                xx: at(0),
                xy: at(1),
                rest: Rest::Yy(at(2)),
            },
            bias_force: [at(3), at(4)],
        };
        (response, self.joints.then(|| at(5)))
    }

    fn outputs(
        &self,
        list: &mut EntryList<'_, '_>,
        response: &Response,
        torque: Option<ValueId>,
    ) -> Vec<ValueId> {
        let Response {
            deficit,
            bias_force: [x, y],
        } = *response;
        let yy = deficit.yy(&mut list.lowering.builder);
        let all = [deficit.xx, deficit.xy, yy, x, y];
        all.into_iter().chain(torque).collect()
    }

    /// Returns the point of the link from which its children hang. If they hang from several
    /// points, returns the point of the child to which the function refers.
    fn children_pivot(&self, list: &mut EntryList<'_, '_>, kind: Kind) -> Pair {
        [Column::Along, Column::Across].map(|column| self.column(list, kind, column))
    }

    /// Returns ĥ/M and 1/M of a leaf.
    fn leaf_constants(&self, list: &mut EntryList<'_, '_>) -> (Pair, ValueId) {
        let gain = [Column::GainAlong, Column::GainAcross];
        let gain = gain.map(|column| self.column(list, Kind::Leaf, column));
        (gain, self.column(list, Kind::Leaf, Column::InverseInertia))
    }

    /// Computes the outputs of a function.
    pub(super) fn of(&self, list: &mut EntryList<'_, '_>, function: LinkFunction) -> Vec<ValueId> {
        match function {
            LinkFunction::Leaf => self.leaf(list),
            LinkFunction::Attach => self.attach(list),
            LinkFunction::Inner => self.inner(list),
            LinkFunction::Pivot => self.pivot(list),
            LinkFunction::Accelerate => self.accelerate(list),
            LinkFunction::AccelerateLeaf => vec![self.accelerate_leaf(list)],
        }
    }

    fn leaf(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let (link, joint) = self.link(list, Kind::Leaf, None);
        let (response, _) = self.leaf_response(list, &link);
        self.outputs(list, &response, self.joints.then_some(joint))
    }

    fn leaf_response(
        &self,
        list: &mut EntryList<'_, '_>,
        link: &ReducedLink,
    ) -> (Response, Elimination) {
        let (gain, inverse) = self.leaf_constants(list);
        let acceleration_choice = self.acceleration_choice(list, link);
        let builder = &mut list.lowering.builder;
        match acceleration_choice {
            None => link.leaf(builder, gain, inverse),
            Some(acceleration_choice) => {
                let alone = link.alone(builder);
                link.prescribe_or_eliminate(builder, &alone, inverse, &acceleration_choice)
            }
        }
    }

    fn attach(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let (response, torque) = self.given(list, Argument::Response);
        if !self.table.has_several_places {
            return self.outputs(list, &response, torque);
        }
        let (link, _) = self.link(list, Kind::Child, None);
        let place = self.children_pivot(list, Kind::Child);
        let builder = &mut list.lowering.builder;
        let attached = link.attach(builder, place, &response, None, true);
        let Attached {
            deficit,
            first_moment,
            inertia,
            force: [x, y],
            torque: turning,
        } = attached;
        // Subtracted from the link's own moment and inertia.
        let [moment_x, moment_y] = first_moment.map(|component| builder.neg(component));
        let inertia = builder.neg(inertia);
        let yy = deficit.yy(builder);
        let all = [
            deficit.xx, deficit.xy, yy, moment_x, moment_y, inertia, x, y, turning,
        ];
        all.into_iter().chain(torque).collect()
    }

    fn inner(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let (whole, link, joint) = if self.table.has_several_places {
            let builder = &mut list.lowering.builder;
            let mut at = |index| builder.input(Argument::Sums, index);
            let deficit = Deficit {
                xx: at(0),
                xy: at(1),
                rest: Rest::Yy(at(2)),
            };
            let (moment, inertia, force, torque) = ([at(3), at(4)], at(5), [at(6), at(7)], at(8));
            let below = self.joints.then(|| at(9));
            let (link, joint) = self.link(list, Kind::Inner, below);
            let builder = &mut list.lowering.builder;
            let alone = link.alone(builder);
            let attached = Attached {
                deficit,
                first_moment: moment.map(|component| builder.neg(component)),
                inertia: builder.neg(inertia),
                force,
                torque,
            };
            (alone.add(builder, &attached), link, joint)
        } else {
            let (response, below) = self.given(list, Argument::Sums);
            let (link, joint) = self.link(list, Kind::Inner, below);
            let place = self.children_pivot(list, Kind::Inner);
            let builder = &mut list.lowering.builder;
            let whole = link.attach(builder, place, &response, Some(link.body()), true);
            (whole, link, joint)
        };
        let acceleration_choice = self.acceleration_choice(list, &link);
        let builder = &mut list.lowering.builder;
        let (response, elimination) = match acceleration_choice {
            None => link.eliminate(builder, &whole),
            Some(acceleration_choice) => {
                let one = builder.integer(1);
                let inverse = builder.div(one, whole.inertia);
                link.prescribe_or_eliminate(builder, &whole, inverse, &acceleration_choice)
            }
        };
        let mut outputs = self.outputs(list, &response, self.joints.then_some(joint));
        let Elimination {
            gain: [x, y],
            offset,
        } = elimination;
        outputs.extend([x, y, offset]);
        outputs
    }

    fn pivot(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let place = self.children_pivot(list, Kind::Child);
        let builder = &mut list.lowering.builder;
        let mut at = |index| builder.input(Argument::Carried, index);
        let gravity = [at(0), at(1)];
        if !self.table.has_several_places {
            return gravity.to_vec();
        }
        let end = [at(2), at(3)];
        let moved = builder.complex_product(place, end);
        builder.sub_pairs(gravity, moved).to_vec()
    }

    fn accelerate(&self, list: &mut EntryList<'_, '_>) -> Vec<ValueId> {
        let (link, _) = self.link(list, Kind::Inner, None);
        let builder = &mut list.lowering.builder;
        let mut at = |argument, index| builder.input(argument, index);
        let elimination = Elimination {
            gain: [at(Argument::Elimination, 0), at(Argument::Elimination, 1)],
            offset: at(Argument::Elimination, 2),
        };
        let gravity = [at(Argument::Pivot, 0), at(Argument::Pivot, 1)];
        let follows = link.accelerate(builder, &elimination, gravity);
        let [tangential, alpha] = self.completed(list, Kind::Inner, &link, follows);
        let builder = &mut list.lowering.builder;
        if self.table.has_several_places {
            let end = link.end_acceleration(builder, tangential);
            return [alpha].into_iter().chain(gravity).chain(end).collect();
        }
        let place = self.children_pivot(list, Kind::Inner);
        let builder = &mut list.lowering.builder;
        let below = link.gravity_at(builder, place, gravity, tangential);
        [alpha].into_iter().chain(below).collect()
    }

    fn accelerate_leaf(&self, list: &mut EntryList<'_, '_>) -> ValueId {
        let (link, _) = self.link(list, Kind::Leaf, None);
        let (_, elimination) = self.leaf_response(list, &link);
        let builder = &mut list.lowering.builder;
        let gravity = [0, 1].map(|index| builder.input(Argument::Pivot, index));
        let follows = link.accelerate(builder, &elimination, gravity);
        let [_, alpha] = self.completed(list, Kind::Leaf, &link, follows);
        alpha
    }
}

/// Elements of [`Argument::Motion`].
#[derive(Clone, Copy)]
pub(super) enum Motion {
    Sine,
    Cosine,
    Omega,
    JointAngle,
    JointRate,
    OutsideTorque,
    Prescribed,
}
