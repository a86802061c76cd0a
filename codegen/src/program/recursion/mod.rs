//! The accelerations by articulated recursion (physics §10; Featherstone,
//! Rigid Body Dynamics Algorithms, 2008, chapter 7): O(n) operations.
//!
//! A subtree of mass S whose pivot is accelerated by a answers with the force
//! S a + γ − N a. From the leaves to the root each link's own acceleration is
//! eliminated from γ and N; from the root to the leaves it is formed. N, the
//! *relief*, is what the free joints take away from the mass: S − N is the
//! articulated inertia.

mod eliminate;
mod relief;
mod torques;
mod units;

use super::ValueId;
use super::builder::Builder;
use super::lower::{Door, Lowering};
use super::pair::Pair;
use crate::mechanics::Trigonometric;
use crate::scene::{LinkId, Scene};
use eliminate::{Eliminated, Sweep};
use units::Units;

impl Lowering<'_> {
    /// θ̈ in the absolute angles.
    pub(super) fn recursion(&mut self, scene: &Scene, door: &mut Door<'_>) -> Vec<ValueId> {
        let frame = door.frame;
        let units = self.units(scene, door);
        let mut directions = Vec::new();
        for &angle in &frame.coordinates {
            let symbols = [Trigonometric::Cos(angle), Trigonometric::Sin(angle)]
                .map(|wanted| self.trigonometric_symbol(wanted));
            directions.push(symbols.map(|symbol| self.symbol(door, symbol)));
        }
        let omega = frame.velocities.iter();
        let omega: Vec<ValueId> = omega.map(|&symbol| self.symbol(door, symbol)).collect();
        let torques = self.joint_torques(scene, &units, door, &omega);
        let root = self.root_fall(&units, door);
        let mut sweep = Sweep {
            scene,
            units,
            names: self.coordinate_names(frame),
            directions,
            torques,
            omega,
            answers: scene.links.iter().map(|_| None).collect(),
        };
        let builder = &mut self.builder;
        let mut eliminated: Vec<Eliminated> = Vec::with_capacity(scene.links.len());
        for link in (0..scene.links.len()).rev() {
            eliminated.push(match scene.links[link].parent {
                Some(_) => sweep.eliminate(builder, link),
                None => sweep.solve_root(builder, link, root),
            });
        }
        eliminated.reverse();
        sweep.descend(builder, &eliminated, root)
    }

    /// −a of the root's pivot, gravity included, in units of length.
    fn root_fall(&mut self, units: &Units, door: &mut Door<'_>) -> Pair {
        let mechanics = self.mechanics;
        let mut pivot = self.builder.zero_pair();
        for motion in mechanics.drive.iter().flat_map(|drive| &drive.pivot) {
            if let Some(acceleration) = motion.acceleration {
                let acceleration = self.symbol(door, acceleration);
                pivot[usize::from(motion.name == "y")] =
                    self.builder.mul(units.per_length, acceleration);
            }
        }
        pivot[1] = self.builder.add(pivot[1], units.gravity);
        pivot.map(|component| self.builder.neg(component))
    }
}

/// The links that hang from `parent`; the root without one.
fn children(scene: &Scene, parent: Option<usize>) -> Vec<usize> {
    let links = scene.links.iter().enumerate();
    links
        .filter(|(_, link)| link.parent.map(|LinkId(index)| index) == parent)
        .map(|(index, _)| index)
        .collect()
}

impl Sweep<'_> {
    /// From the root to the leaves, (10.8): ω̇ of each link and, as `fall`, −a of
    /// the pivots on it.
    fn descend(
        &self,
        builder: &mut Builder,
        eliminated: &[Eliminated],
        root: Pair,
    ) -> Vec<ValueId> {
        let mut falls = vec![root; eliminated.len()];
        let mut accelerations = Vec::with_capacity(eliminated.len());
        for (link, solved) in eliminated.iter().enumerate() {
            let name = &self.names[link];
            // The offset first: what it is formed of need not be kept for this.
            let mut tangential = solved.offset;
            for (gain, fall) in solved.gain.into_iter().zip(falls[link]) {
                let answer = builder.mul(gain, fall);
                tangential = builder.add(tangential, answer);
            }
            let inverse_length = self.unit(link).inverse_length;
            if !builder.is(inverse_length, 1) {
                builder.name(tangential, &format!("tangential_{name}"));
            }
            let alpha = builder.mul(inverse_length, tangential);
            accelerations.push(builder.name(alpha, &format!("alpha_{name}")));
            for (number, (place, members)) in solved.groups.iter().enumerate() {
                // a + y (ω̇ + i ω²)
                let y = builder.turn(*place, self.directions[link]);
                let inwards = builder.scale_pair(solved.centripetal, y);
                let forwards = builder.scale_pair(tangential, y);
                let steady = [
                    builder.add(falls[link][0], inwards[1]),
                    builder.sub(falls[link][1], inwards[0]),
                ];
                let fall = builder.sub_pairs(steady, forwards);
                builder.name_pair(fall, &format!("fall@_{}", numbered(name, number)));
                for &member in members {
                    falls[member] = fall;
                }
            }
        }
        accelerations
    }
}

/// `name`, `name_2`, … for the pivots on one link.
fn numbered(name: &str, number: usize) -> String {
    match number {
        0 => name.to_owned(),
        _ => format!("{name}_{}", number + 1),
    }
}
