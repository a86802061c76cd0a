//! Constants of springs and friction between links of a tree in loops.

use super::loop_tree::SpringDamperConstants;
use crate::program::lower::Lowering;
use crate::scene::{DescribedSpringDamper, FrictionContact, Scene};

impl Lowering<'_> {
    /// Returns the spring-dampers of a scene that connect at least one pair of its links.
    pub(super) fn spring_damper_constants(&mut self, scene: &Scene) -> Vec<SpringDamperConstants> {
        let mut found = Vec::new();
        for DescribedSpringDamper {
            what,
            ends,
            torques,
        } in &scene.spring_dampers
        {
            let pairs = scene.pair_runs(ends);
            if pairs.is_empty() {
                continue;
            }
            let law = torques.law(FrictionContact::Joint);
            let values = law.each_ref().into_constants();
            found.push(SpringDamperConstants {
                what: what.clone(),
                pairs,
                spring: self.quantity(&torques.spring),
                rest: self.quantity(&torques.rest),
                friction: self.quantity(&torques.friction),
                law: (!law.is_none()).then(|| values.map(|quantity| self.quantity(quantity))),
            });
        }
        found
    }
}
