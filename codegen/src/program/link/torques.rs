//! Torques in the joints, against the ground and on the root.

use super::reduced_units::Units;
use crate::mechanics::{LineTorque, PairElement, TorqueSource};
use crate::program::ValueId;
use crate::program::lower::{Environment, Lowering};
use crate::scene::{LinkId, Scene};

impl Lowering<'_> {
    /// Computes the torque Q of each link, in its unit of torque. Q contains external torques, −c
    /// (ω − ω_π), other friction and −κ (θ − θ_π − ρ) of the link's own joint minus those of its
    /// children's joints, the corresponding terms between the link and others that are not its
    /// parent, −k ω, and τ on the root. π denotes the parent.
    pub(super) fn joint_torques(
        &mut self,
        scene: &Scene,
        units: &Units,
        environment: &mut Environment<'_>,
        omega: &[ValueId],
    ) -> Vec<ValueId> {
        let zero = self.builder.integer(0);
        let mut torques = vec![zero; scene.links.len()];
        let theta = environment.frame.coordinates.iter();
        let theta: Vec<ValueId> = theta
            .map(|&symbol| self.symbol(environment, symbol))
            .collect();
        self.outside_torques(scene, units, environment, &mut torques);
        self.friction_torques(scene, units, environment, &mut torques);
        self.pair_torques(scene, units, environment, &mut torques);
        self.line_torques(scene, units, environment, &mut torques);
        self.linear_torques(scene, units, [&theta, omega], &mut torques);
        torques
    }

    /// Adds external torques, and τ on the root.
    fn outside_torques(
        &mut self,
        scene: &Scene,
        units: &Units,
        environment: &mut Environment<'_>,
        torques: &mut [ValueId],
    ) {
        if let Some(argument) = environment.torques {
            for (index, link) in scene.links.iter().enumerate() {
                let outside = self.builder.input(argument, index);
                let unit = &units.links[link.orbit.0];
                torques[index] = self.builder.mul(unit.per_torque, outside);
            }
        }
        let drive = self.mechanics.drive.as_ref();
        if let Some(torque) = drive.and_then(|drive| drive.torque) {
            let torque = self.symbol(environment, torque);
            let torque = self.builder.mul(units.links[0].per_torque, torque);
            torques[0] = self.builder.add(torques[0], torque);
        }
    }

    /// Adds the torques of friction that is not viscous.
    fn friction_torques(
        &mut self,
        scene: &Scene,
        units: &Units,
        environment: &mut Environment<'_>,
        torques: &mut [ValueId],
    ) {
        for torque in &environment.frame.torques {
            let TorqueSource::Link { link, against, .. } = torque.source else {
                continue;
            };
            let braking = self.symbol(environment, torque.symbol);
            let unit = &units.links[scene.links[link.0].orbit.0];
            let own = self.builder.mul(unit.per_torque, braking);
            torques[link.0] = self.builder.sub(torques[link.0], own);
            if let Some(other) = against {
                let unit = &units.links[scene.links[other.0].orbit.0];
                let reaction = self.builder.mul(unit.per_torque, braking);
                torques[other.0] = self.builder.add(torques[other.0], reaction);
            }
        }
    }

    /// Adds −c (ω − ω_π) and −κ (θ − θ_π − ρ) of each joint to its link, and the opposite to its
    /// parent π; and −k ω.
    fn linear_torques(
        &mut self,
        scene: &Scene,
        units: &Units,
        [theta, omega]: [&[ValueId]; 2],
        torques: &mut [ValueId],
    ) {
        let builder = &mut self.builder;
        let children = super::children(scene);
        let below = |parent: Option<usize>| parent.map_or(&[0][..], |parent| &children[parent]);
        for parent in std::iter::once(None).chain((0..scene.links.len()).map(Some)) {
            // Sums of the relative motions of equal joints on one parent.
            let mut sums: Vec<(&str, ValueId, ValueId)> = Vec::new();
            for &link in below(parent) {
                let unit = &units.links[scene.links[link].orbit.0];
                let joint = [
                    ("joint_rate", unit.passive.friction, omega),
                    ("joint_angle", unit.passive.spring, theta),
                ];
                for (what, coefficient, state) in joint {
                    if builder.is(coefficient, 0) {
                        continue;
                    }
                    let mut relative = match parent {
                        Some(parent) => builder.sub(state[link], state[parent]),
                        None => state[link],
                    };
                    builder.name(relative, &format!("{what}_{}", scene.links[link].name));
                    if what == "joint_angle" && !builder.is(unit.passive.rest, 0) {
                        relative = builder.sub(relative, unit.passive.rest);
                        builder.name(relative, &format!("deflection_{}", scene.links[link].name));
                    }
                    let reduced = builder.mul(coefficient, unit.per_torque);
                    let torque = builder.mul(reduced, relative);
                    torques[link] = builder.sub(torques[link], torque);
                    let known = sums
                        .iter_mut()
                        .find(|(kind, known, _)| *kind == what && *known == coefficient);
                    match known {
                        Some((.., sum)) => *sum = builder.add(*sum, relative),
                        None => sums.push((what, coefficient, relative)),
                    }
                }
                let reduced = builder.mul(unit.passive.drag, unit.per_torque);
                let torque = builder.mul(reduced, omega[link]);
                torques[link] = builder.sub(torques[link], torque);
            }
            let Some(parent) = parent else { continue };
            let unit = &units.links[scene.links[parent].orbit.0];
            for (_, coefficient, sum) in sums {
                let reduced = builder.mul(coefficient, unit.per_torque);
                let torque = builder.mul(reduced, sum);
                torques[parent] = builder.add(torques[parent], torque);
            }
        }
    }

    /// Adds −(dU/dℓ + γ ℓ̇) ∂ℓ/∂θ_i of each line, with its length ℓ, energy U and damping
    /// coefficient γ.
    fn line_torques(
        &mut self,
        scene: &Scene,
        units: &Units,
        environment: &mut Environment<'_>,
        torques: &mut [ValueId],
    ) {
        for LineTorque { link, torque } in &self.mechanics.articulation.lines {
            let torque = self.expr(environment, torque);
            let unit = &units.links[scene.links[link.0].orbit.0];
            let own = self.builder.mul(unit.per_torque, torque);
            torques[link.0] = self.builder.sub(torques[link.0], own);
        }
    }

    /// Adds −κ (θ_a − θ_b − ρ) − c (ω_a − ω_b) to the first link of each pair, and the opposite to
    /// the second.
    fn pair_torques(
        &mut self,
        scene: &Scene,
        units: &Units,
        environment: &mut Environment<'_>,
        torques: &mut [ValueId],
    ) {
        for PairElement {
            pair,
            strain,
            rate,
            passive,
        } in &self.mechanics.articulation.pairs
        {
            for (coefficient, difference) in [(&passive.spring, strain), (&passive.friction, rate)]
            {
                if coefficient.is_zero() {
                    continue;
                }
                let coefficient = self.expr(environment, coefficient);
                let difference = self.expr(environment, difference);
                let builder = &mut self.builder;
                let [own, other] = pair.links.map(|LinkId(link)| {
                    let unit = &units.links[scene.links[link].orbit.0];
                    let reduced = builder.mul(coefficient, unit.per_torque);
                    (link, builder.mul(reduced, difference))
                });
                torques[own.0] = builder.sub(torques[own.0], own.1);
                torques[other.0] = builder.add(torques[other.0], other.1);
            }
        }
    }
}
