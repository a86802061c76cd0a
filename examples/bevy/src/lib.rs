//! A plugin for [Bevy](https://bevy.org) that moves pendulum trees and lets a hand hold them.
//!
//! A game spawns a [`Swaying`] tree from a description, reads the positions of its links, and adds
//! a [`Hand`] to the entity while the mouse button is pressed. Trees move in the fixed time steps
//! of the game.

use bevy_app::{App, FixedUpdate, Plugin};
use bevy_ecs::prelude::{Component, Query, Res};
use bevy_time::Time;
use branched_pendulum::integrate::{Frames, longest_sub_step};
use branched_pendulum::prelude::*;
use branched_pendulum::system::{LinkPoint, Positions, UnderTorques};
use branched_pendulum_trees::PendulumTree;

type Equations = UnderTorques<PendulumTree<f32>, Vec<f32>>;

/// Plugin that moves all [`Swaying`] trees in `FixedUpdate`.
pub struct SwayingPlugin;

impl Plugin for SwayingPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(FixedUpdate, sway);
    }
}

/// A tree that the plugin moves.
#[derive(Component)]
pub struct Swaying {
    tree: PendulumTree<f32>,
    frames: Frames<Equations, f32>,
}

/// A hand that holds the end of a link of the tree on the same entity.
#[derive(Component)]
pub struct Hand {
    /// Number of the link, in the order of the angles.
    pub link: usize,
    /// Position of the hand in m, relative to the root's pivot, y upwards.
    pub at: [f32; 2],
}

impl Swaying {
    /// Creates a tree at rest at these angles (rad), one for each link.
    ///
    /// # Errors
    /// Fails if the description is wrong or the number of angles is not the number of links.
    pub fn new(description: &str, angles: &[f32]) -> Result<Self, Box<dyn std::error::Error>> {
        let tree = PendulumTree::parse(description)?.cast(|number| number as f32);
        let still = UnderTorques::of(tree.clone(), vec![0.0; tree.links()]);
        let start = State::at_rest(0.0, angles);
        let frames = Frames::new(still, &start, longest_sub_step(&tree))?;
        Ok(Self { tree, frames })
    }

    /// Returns the ends of all links in m, relative to the root's pivot, y upwards.
    pub fn ends(&self) -> Vec<[f32; 2]> {
        self.tree.points(LinkPoint::End, self.halves().0)
    }

    /// Returns the energy in J, relative to all links hanging at rest.
    pub fn energy(&self) -> f32 {
        let (theta, omega) = self.halves();
        let still = vec![0.0; theta.len()];
        self.tree.energy_of(theta, omega) - self.tree.energy_of(&still, &still)
    }

    /// Splits the state into angles (rad) and their rates (rad/s).
    fn halves(&self) -> (&[f32], &[f32]) {
        self.frames.state().split_at(self.tree.links())
    }

    /// Returns the torques of a spring and a damper between the end of a link and the hand. They
    /// are constant during a step of `step` seconds, which limits their stiffness: they are chosen
    /// so that the held point, with its effective mass m, moves critically damped with the
    /// frequency 1 / (2 `step`) (rad/s).
    fn pull(&self, hand: &Hand, step: f32) -> Vec<f32> {
        let (theta, omega) = self.halves();
        let mut forces = vec![[0.0; 2]; theta.len()];
        let (Some(end), Some(force)) = (
            self.ends().get(hand.link).copied(),
            forces.get_mut(hand.link),
        ) else {
            return vec![0.0; theta.len()];
        };
        let velocity = self.tree.point_velocities(LinkPoint::End, theta, omega)[hand.link];
        let rate = 0.5 / step;
        // The acceleration that the point is to have.
        let wanted =
            [0, 1].map(|axis| rate * (rate * (hand.at[axis] - end[axis]) - 2.0 * velocity[axis]));
        let size = wanted[0].hypot(wanted[1]);
        if size == 0.0 {
            return vec![0.0; theta.len()];
        }
        // How the point gives way to 1 N in that direction: 1 / m.
        *force = wanted.map(|axis| axis / size);
        let direction = *force;
        let torques = self.tree.point_torques(LinkPoint::End, theta, &forces);
        let (mut pushed, mut free) = (vec![0.0; theta.len()], vec![0.0; theta.len()]);
        let still = vec![0.0; theta.len()];
        self.tree
            .accelerations_under_into(0.0, theta, &still, &torques, &mut pushed);
        self.tree
            .accelerations_under_into(0.0, theta, &still, &still, &mut free);
        let turning: Vec<f32> = pushed
            .iter()
            .zip(&free)
            .map(|(pushed, free)| pushed - free)
            .collect();
        let given = self.tree.point_velocities(LinkPoint::End, theta, &turning)[hand.link];
        let softness = given[0] * direction[0] + given[1] * direction[1];
        // Along a link that is stretched out the point gives way to nothing: no heavier than the tree.
        let masses = (0..theta.len()).filter_map(|link| Some(self.tree.properties_of(link)?.mass));
        let mass = (1.0 / softness.max(f32::MIN_POSITIVE)).min(masses.sum());
        torques.iter().map(|torque| mass * size * torque).collect()
    }
}

fn sway(time: Res<Time>, mut trees: Query<(&mut Swaying, Option<&Hand>)>) {
    let step = time.delta_secs();
    for (mut tree, hand) in &mut trees {
        let torques = match hand {
            Some(hand) => tree.pull(hand, step),
            None => vec![0.0; tree.tree.links()],
        };
        tree.frames
            .ode_mut()
            .torques_mut()
            .copy_from_slice(&torques);
        tree.frames.advance(step);
    }
}
