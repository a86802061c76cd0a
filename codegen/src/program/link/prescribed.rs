//! Links with prescribed accelerations. In trees that are written out, these links are known when
//! the code is generated; in loops, numbers select them (physics (13.6); Featherstone, Rigid Body
//! Dynamics Algorithms, 2008, §9.2).

use super::columns::Column;
use super::deficit::Deficit;
use super::equations::{Attached, Elimination, ReducedLink, Response, passed_on};
use super::functions::{Functions, Kind, Motion};
use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::entry_list::EntryList;
use crate::program::pair::Pair;

/// Selection, by two numbers, between a prescribed and a computed acceleration of a link. It avoids
/// a branch, because links evaluated together may differ in this.
pub(super) struct AccelerationChoice {
    /// 1 if the acceleration is prescribed, 0 if it is computed.
    pub(super) prescribed: ValueId,
    /// 1 − `held`.
    pub(super) free: ValueId,
    /// Prescribed acceleration in the link's unit of length, 0 if it is computed.
    pub(super) tangential: ValueId,
}

/// State of a link with a prescribed acceleration.
pub(super) struct PrescribedLink {
    /// Angular acceleration ω̇, in the link's unit of length and in rad/s².
    pub(super) acceleration: [ValueId; 2],
    /// Coefficient b of the pivot's acceleration.
    first_moment: Pair,
    /// Torque J ω̇ + κ that the acceleration needs, without the part b·a of the pivot's
    /// acceleration.
    steady_torque: ValueId,
}

impl PrescribedLink {
    /// Computes the reaction torque J ω̇ + b·a + κ: the torque that the prescribed acceleration
    /// needs in addition to all other torques on the link. `gravity` is −a.
    pub(super) fn reaction(&self, builder: &mut Builder, gravity: Pair) -> ValueId {
        let pull = builder.dot(self.first_moment, gravity);
        builder.sub(self.steady_torque, pull)
    }
}

impl ReducedLink {
    /// Computes the response of a link with a prescribed acceleration. Nothing is eliminated: N = Σ
    /// N, γ = γ' + b ω̇. `whole` is the contribution of the link and its subtrees.
    pub(super) fn prescribe(
        &self,
        builder: &mut Builder,
        whole: &Attached,
        alpha: ValueId,
    ) -> (Response, PrescribedLink) {
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
        let prescribed = PrescribedLink {
            acceleration: [tangential, alpha],
            first_moment,
            steady_torque: builder.sub(own, torque),
        };
        (response, prescribed)
    }

    /// Computes the response of a link with a prescribed or computed acceleration, as
    /// [`prescribe`](Self::prescribe) or [`eliminate`](Self::eliminate) do; `inverse` is 1/J. The downward
    /// pass then computes (−b·a − κ)/J, or for a prescribed link −b·a − κ − J ω̇, its reaction with
    /// the opposite sign.
    pub(super) fn prescribe_or_eliminate(
        &self,
        builder: &mut Builder,
        whole: &Attached,
        inverse: ValueId,
        acceleration_choice: &AccelerationChoice,
    ) -> (Response, Elimination) {
        let suffix = &self.suffix;
        let first_moment = builder.name_pair(whole.first_moment, &format!("first_moment@{suffix}"));
        let torque = self.net_torque(builder, whole);
        let yielding = builder.mul(acceleration_choice.free, inverse);
        builder.name(yielding, &format!("yielding{suffix}"));
        let factor = builder.add(yielding, acceleration_choice.prescribed);
        let gain = builder.scale_pair(factor, first_moment);
        builder.name_pair(gain, &format!("gain@{suffix}"));
        let (swung, pulled) = (
            builder.mul(whole.inertia, acceleration_choice.tangential),
            builder.mul(factor, torque),
        );
        let offset = builder.sub(swung, pulled);
        builder.name(offset, &format!("offset{suffix}"));
        let taken = builder.scale_pair(yielding, first_moment);
        let own = Deficit::product(builder, first_moment, taken);
        let steady = builder.mul(yielding, torque);
        let steady = builder.add(steady, acceleration_choice.tangential);
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
    /// Returns the selection between a prescribed and a computed acceleration, if links may be
    /// prescribed.
    pub(super) fn acceleration_choice(
        &self,
        list: &mut EntryList<'_, '_>,
        link: &ReducedLink,
    ) -> Option<AccelerationChoice> {
        if !self.prescribed {
            return None;
        }
        let [prescribed, given] =
            [Motion::Prescribed, Motion::OutsideTorque].map(|at| self.motion(list, at));
        let builder = &mut list.lowering.builder;
        let one = builder.integer(1);
        let acceleration = builder.mul(prescribed, given);
        Some(AccelerationChoice {
            prescribed,
            free: builder.sub(one, prescribed),
            tangential: builder.mul(link.length, acceleration),
        })
    }

    /// Completes the results of a link in the downward pass, ω̇ in the link's unit of length and in
    /// rad/s². For a prescribed link, the first is the prescribed one and the second is replaced by
    /// the reaction torque in N m.
    pub(super) fn completed(
        &self,
        list: &mut EntryList<'_, '_>,
        kind: Kind,
        link: &ReducedLink,
        [tangential, alpha]: [ValueId; 2],
    ) -> [ValueId; 2] {
        let Some(acceleration_choice) = self.acceleration_choice(list, link) else {
            return [tangential, alpha];
        };
        let unit = self.column(list, kind, Column::TorqueUnit);
        let builder = &mut list.lowering.builder;
        let unit = builder.mul(unit, link.length);
        let pull = builder.mul(unit, tangential);
        let (own, pull) = (
            builder.mul(acceleration_choice.free, alpha),
            builder.mul(acceleration_choice.prescribed, pull),
        );
        let follows = builder.mul(acceleration_choice.free, tangential);
        [
            builder.add(follows, acceleration_choice.tangential),
            builder.sub(own, pull),
        ]
    }
}
