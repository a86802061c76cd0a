//! One link of the way up, physics (10.4) to (10.7).

use super::relief::{Relief, Rest};
use super::units::{Unit, Units};
use super::{children, numbered};
use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::pair::Pair;
use crate::scene::Scene;

/// The elimination in progress.
pub(super) struct Sweep<'s> {
    pub(super) scene: &'s Scene,
    pub(super) units: Units,
    pub(super) names: Vec<String>,
    /// v of each link.
    pub(super) directions: Vec<Pair>,
    pub(super) torques: Vec<ValueId>,
    pub(super) omega: Vec<ValueId>,
    /// N and γ of the subtrees that are eliminated.
    pub(super) answers: Vec<Option<(Relief, Pair)>>,
}

/// What the way down needs of a link: ω̇ = −(b·a + κ)/J.
pub(super) struct Eliminated {
    /// The pivots on the link and what hangs from each.
    pub(super) groups: Vec<(Pair, Vec<usize>)>,
    /// b/J.
    pub(super) gain: Pair,
    /// −κ/J.
    pub(super) offset: ValueId,
    /// ω².
    pub(super) centripetal: ValueId,
}

/// The subtrees that hang from one pivot of a link.
struct Group {
    /// Where, in the link's unit of length: ρ.
    place: Pair,
    /// ρ v.
    y: Pair,
    members: Vec<usize>,
    relief: Relief,
    force: Pair,
}

/// A link that turns with what hangs from it.
struct Turning {
    groups: Vec<Group>,
    /// b = η v − z.
    arm: Pair,
    /// η v + z.
    throw: Pair,
    /// J.
    inertia: ValueId,
    /// Σ y × N y.
    cross: ValueId,
    /// ω².
    centripetal: ValueId,
}

impl Sweep<'_> {
    pub(super) fn unit(&self, link: usize) -> &Unit {
        &self.units.links[self.scene.links[link].orbit.0]
    }

    /// The subtrees below a link, by pivot.
    fn groups(&mut self, builder: &mut Builder, link: usize) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for child in children(self.scene, Some(link)) {
            let place = self.unit(child).place;
            let Some((relief, force)) = self.answers[child].take() else {
                unreachable!("children are eliminated before their parents");
            };
            match groups.iter_mut().find(|group| group.place == place) {
                Some(group) => {
                    group.members.push(child);
                    group.relief = group.relief.add(builder, &relief);
                    group.force = builder.add_pairs(group.force, force);
                }
                None => groups.push(Group {
                    place,
                    y: builder.turn(place, self.directions[link]),
                    members: vec![child],
                    relief,
                    force,
                }),
            }
        }
        for (number, group) in groups.iter().enumerate() {
            if group.members.len() > 1 {
                let below = format!("below_{}", numbered(&self.names[link], number));
                group.relief.name(builder, &below);
                builder.name_pair(group.force, &format!("force@_{below}"));
            }
        }
        groups
    }

    /// (10.4), (10.5).
    fn turning(&mut self, builder: &mut Builder, link: usize) -> Turning {
        let groups = self.groups(builder, link);
        let unit = self.unit(link);
        let (moment, inertia, length) = (unit.moment, unit.inertia, unit.length);
        let v = self.directions[link];
        let name = &self.names[link];
        let squared = builder.mul(self.omega[link], self.omega[link]);
        let centripetal = builder.mul(length, squared);
        builder.name(centripetal, &format!("centripetal_{name}"));
        // Where all traces are constants so is η, and N enters without them.
        let plain = groups.iter().all(|group| group.relief.has_constant_trace());
        let two = builder.integer(2);
        let (mut free, mut lever) = (inertia, moment);
        if plain {
            for group in &groups {
                let half = group.relief.half_trace(builder);
                let part = builder.scale_pair(half, group.place);
                lever = builder.sub_pairs(lever, part);
                let square = builder.dot(group.place, group.place);
                let part = builder.mul(half, square);
                free = builder.sub(free, part);
            }
        } else {
            // 2 η
            lever = builder.scale_pair(two, moment);
            for group in &groups {
                let trace = group.relief.trace(builder);
                let part = builder.scale_pair(trace, group.place);
                lever = builder.sub_pairs(lever, part);
            }
        }
        let mut answer = builder.zero_pair();
        let mut cross = builder.integer(0);
        for (number, group) in groups.iter().enumerate() {
            let part = match plain {
                true => group.relief.deviator_times(builder, group.y),
                false => group.relief.times(builder, group.y),
            };
            builder.name_pair(part, &format!("relieved@_{}", numbered(name, number)));
            // One product after the other: each is fused with its difference.
            for (component, relieved) in group.y.into_iter().zip(part) {
                let along = builder.mul(component, relieved);
                free = builder.sub(free, along);
            }
            let across = builder.cross(group.y, part);
            cross = builder.add(cross, across);
            answer = builder.add_pairs(answer, part);
        }
        let levered = builder.turn(lever, v);
        builder.name_pair(levered, &format!("lever@_{name}"));
        let (arm, throw) = if plain {
            let arm = builder.sub_pairs(levered, answer);
            (arm, builder.add_pairs(levered, answer))
        } else {
            let whole = builder.turn(moment, v);
            let arm = builder.sub_pairs(whole, answer);
            (arm, builder.sub_pairs(levered, arm))
        };
        builder.name_pair(arm, &format!("arm@_{name}"));
        builder.name(free, &format!("articulated_inertia_{name}"));
        Turning {
            groups,
            arm,
            throw,
            inertia: free,
            cross,
            centripetal,
        }
    }

    /// Eliminates a link's angular acceleration, (10.6), (10.7).
    pub(super) fn eliminate(&mut self, builder: &mut Builder, link: usize) -> Eliminated {
        let turning = self.turning(builder, link);
        let name = self.names[link].clone();
        let unit = self.unit(link);
        let (moment, v) = (unit.moment, self.directions[link]);
        let (one, zero) = (builder.integer(1), builder.integer(0));
        // γ' = Σ γ + i ω² (η v + z)
        let mut force = builder.zero_pair();
        for group in &turning.groups {
            force = builder.add_pairs(force, group.force);
        }
        let thrown = builder.scale_pair(turning.centripetal, turning.throw);
        let force = [
            builder.sub(force[0], thrown[1]),
            builder.add(force[1], thrown[0]),
        ];
        builder.name_pair(force, &format!("load@_{name}"));
        // One pivot in the link's direction: −κ = Q − v·γ'.
        let simple = builder.is(moment[1], 0)
            && matches!(&turning.groups[..], [group] if group.place == [one, zero]);
        let torque = match simple {
            true => {
                let load = builder.dot(v, force);
                builder.sub(self.torques[link], load)
            }
            false => self.torque(builder, link, &turning),
        };
        builder.name(torque, &format!("torque_{name}"));
        let inverse = builder.div(one, turning.inertia);
        builder.name(inverse, &format!("inverse_articulated_inertia_{name}"));
        let gain = builder.scale_pair(inverse, turning.arm);
        builder.name_pair(gain, &format!("gain@_{name}"));
        let offset = builder.mul(torque, inverse);
        builder.name(offset, &format!("offset_{name}"));
        let passed_on = builder.scale_pair(torque, gain);
        let force = builder.add_pairs(force, passed_on);
        builder.name_pair(force, &format!("force@_{name}"));
        let relief = self.relief(builder, link, &turning, gain);
        relief.name(builder, &name);
        self.answers[link] = Some((relief, force));
        Eliminated {
            groups: places(turning.groups),
            gain,
            offset,
            centripetal: turning.centripetal,
        }
    }

    /// The root is accelerated as given, so that nothing of it is eliminated.
    pub(super) fn solve_root(
        &mut self,
        builder: &mut Builder,
        link: usize,
        fall: Pair,
    ) -> Eliminated {
        let turning = self.turning(builder, link);
        let torque = self.torque(builder, link, &turning);
        let driving = builder.dot(turning.arm, fall);
        let rest = builder.add(driving, torque);
        let offset = builder.div(rest, turning.inertia);
        Eliminated {
            groups: places(turning.groups),
            gain: builder.zero_pair(),
            offset,
            centripetal: turning.centripetal,
        }
    }

    /// −κ = Q − Σ y·γ + ω² Σ y × N y.
    fn torque(&self, builder: &mut Builder, link: usize, turning: &Turning) -> ValueId {
        let mut load = builder.integer(0);
        for group in &turning.groups {
            let part = builder.dot(group.y, group.force);
            load = builder.add(load, part);
        }
        let across = builder.mul(turning.centripetal, turning.cross);
        let load = builder.sub(load, across);
        builder.sub(self.torques[link], load)
    }

    /// Σ N + b bᵀ/J.
    fn relief(&self, builder: &mut Builder, link: usize, turning: &Turning, gain: Pair) -> Relief {
        let arm = turning.arm;
        let mut sum = Relief::zero(builder);
        for group in &turning.groups {
            sum = sum.add(builder, &group.relief);
        }
        let own = Relief {
            xx: builder.mul(arm[0], gain[0]),
            xy: builder.mul(arm[0], gain[1]),
            rest: if turning.groups.is_empty() {
                let unit = self.unit(link);
                let square = builder.dot(unit.moment, unit.moment);
                Rest::Trace(builder.div(square, unit.inertia))
            } else {
                Rest::Yy(builder.mul(arm[1], gain[1]))
            },
        };
        sum.add(builder, &own)
    }
}

fn places(groups: Vec<Group>) -> Vec<(Pair, Vec<usize>)> {
    let groups = groups.into_iter();
    groups.map(|group| (group.place, group.members)).collect()
}
