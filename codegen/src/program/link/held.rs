//! Links whose acceleration is given: in trees that are written out, where it is known of
//! each link, and in loops, where numbers say it (physics (13.6); Featherstone, Rigid Body
//! Dynamics Algorithms, 2008, §9.2).

use super::columns::Column;
use super::deficit::Deficit;
use super::equations::{Attached, Elimination, ReducedLink, Response, passed_on};
use super::functions::{Functions, Kind, Motion};
use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::entry_list::EntryList;
use crate::program::pair::Pair;

/// Choice between a given acceleration of a link and one that follows, as numbers: of
/// links side by side each has its own.
pub(super) struct Grip {
    /// 1 where the acceleration is given, 0 where it follows.
    pub(super) held: ValueId,
    /// 1 − `held`.
    pub(super) free: ValueId,
    /// The given acceleration in units of length, 0 where it follows.
    pub(super) tangential: ValueId,
}

/// A link whose acceleration is given.
pub(super) struct HeldLink {
    /// ω̇ in units of length and in rad/s².
    pub(super) acceleration: [ValueId; 2],
    /// b.
    first_moment: Pair,
    /// J ω̇ + κ: the torque that it takes but for b·a.
    steady_torque: ValueId,
}

impl HeldLink {
    /// The torque that the acceleration takes beyond those on the link, J ω̇ + b·a + κ,
    /// where `gravity` is −a.
    pub(super) fn reaction(&self, builder: &mut Builder, gravity: Pair) -> ValueId {
        let pull = builder.dot(self.first_moment, gravity);
        builder.sub(self.steady_torque, pull)
    }
}

impl ReducedLink {
    /// The response of a link with a given acceleration, of which nothing is eliminated:
    /// N = Σ N, γ = γ' + b ω̇. `whole` is the link with what hangs from it.
    pub(super) fn hold(
        &self,
        builder: &mut Builder,
        whole: &Attached,
        alpha: ValueId,
    ) -> (Response, HeldLink) {
        let suffix = &self.suffix;
        let first_moment = builder.name_pair(whole.first_moment, &format!("first_moment@{suffix}"));
        let tangential = builder.mul(self.length, alpha);
        builder.name(tangential, &format!("tangential{suffix}"));
        let torque = self.net_torque(builder, whole);
        let own = builder.mul(whole.inertia, tangential);
        let swing = builder.scale_pair(tangential, first_moment);
        let response = Response {
            deficit: whole.deficit.less_mass(builder, self.mass),
            bias_force: builder.add_pairs(whole.force, swing),
        };
        response.name(builder, suffix);
        let held = HeldLink {
            acceleration: [tangential, alpha],
            first_moment,
            steady_torque: builder.sub(own, torque),
        };
        (response, held)
    }

    /// The response of a link that is held or free, as [`hold`](Self::hold) or
    /// [`eliminate`](Self::eliminate) have it; `inverse` is 1/J. On the way down what is
    /// not given follows: −b·a − κ over J, and of a held link −b·a − κ − J ω̇, its reaction
    /// but for the sign.
    pub(super) fn hold_or_eliminate(
        &self,
        builder: &mut Builder,
        whole: &Attached,
        inverse: ValueId,
        grip: &Grip,
    ) -> (Response, Elimination) {
        let suffix = &self.suffix;
        let first_moment = builder.name_pair(whole.first_moment, &format!("first_moment@{suffix}"));
        let torque = self.net_torque(builder, whole);
        let yielding = builder.mul(grip.free, inverse);
        builder.name(yielding, &format!("yielding{suffix}"));
        let factor = builder.add(yielding, grip.held);
        let gain = builder.scale_pair(factor, first_moment);
        builder.name_pair(gain, &format!("gain@{suffix}"));
        let (swung, pulled) = (
            builder.mul(whole.inertia, grip.tangential),
            builder.mul(factor, torque),
        );
        let offset = builder.sub(swung, pulled);
        builder.name(offset, &format!("offset{suffix}"));
        let taken = builder.scale_pair(yielding, first_moment);
        let own = Deficit::product(builder, first_moment, taken);
        let steady = builder.mul(yielding, torque);
        let steady = builder.add(steady, grip.tangential);
        let deficit = whole.deficit.less_mass(builder, self.mass);
        let response = Response {
            deficit: deficit.add(builder, &own),
            bias_force: passed_on(builder, whole.force, steady, first_moment),
        };
        response.name(builder, suffix);
        (response, Elimination { gain, offset })
    }
}

impl Functions<'_> {
    /// The choice between a given acceleration and one that follows, where links may be
    /// held.
    pub(super) fn grip(&self, list: &mut EntryList<'_, '_>, link: &ReducedLink) -> Option<Grip> {
        if !self.prescribed {
            return None;
        }
        let [held, given] = [Motion::Held, Motion::OutsideTorque].map(|at| self.motion(list, at));
        let builder = &mut list.lowering.builder;
        let one = builder.integer(1);
        let acceleration = builder.mul(held, given);
        Some(Grip {
            held,
            free: builder.sub(one, held),
            tangential: builder.mul(link.length, acceleration),
        })
    }

    /// Completes what follows of a link on the way down, ω̇ in units of length and in
    /// rad/s²: the first is that of a held link where it is given, and in place of the
    /// second stands its reaction then, in N m.
    pub(super) fn completed(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        link: &ReducedLink,
        [tangential, alpha]: [ValueId; 2],
    ) -> [ValueId; 2] {
        let Some(grip) = self.grip(list, link) else {
            return [tangential, alpha];
        };
        let unit = self.column(list, kind, Column::TorqueUnit);
        let builder = &mut list.lowering.builder;
        let unit = builder.mul(unit, link.length);
        let pull = builder.mul(unit, tangential);
        let (own, pull) = (builder.mul(grip.free, alpha), builder.mul(grip.held, pull));
        let follows = builder.mul(grip.free, tangential);
        [
            builder.add(follows, grip.tangential),
            builder.sub(own, pull),
        ]
    }
}
