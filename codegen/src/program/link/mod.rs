//! Equations of one link in a tree, by articulated recursion (physics §10; Featherstone, Rigid Body
//! Dynamics Algorithms, 2008, chapter 7): O(n) operations.
//!
//! A subtree whose pivot has the acceleration a responds with the force S a + γ − N a. The mass S
//! is a part of its parent's constants. From the leaves to the root, each link's acceleration is
//! eliminated from the bias force γ and the deficit N; from the root to the leaves it is computed.
//! `equations` contains the equations of one link, `tree` applies them to a tree that is written
//! out.

mod body;
mod columns;
mod deficit;
mod entries;
mod equations;
mod functions;
mod known;
mod lines;
mod loop_tree;
mod prescribed;
mod quantities;
mod reduced_units;
mod root;
mod scales;
mod spring_dampers;
mod strips;
mod torques;
mod tree;
mod virtual_power;

pub use columns::Column;
pub use loop_tree::{
    ConstantSlope, LINK_MOTION, LineConstants, LinePotentialConstants, LoopTree, PowerConstants,
    SpringDamperConstants, StripConstants,
};
pub use virtual_power::passive_link_columns;

use crate::scene::{Layout, LinkId, Scene};

/// Returns true if links have torques other than those of their joints. Derivatives of the
/// accelerations need the accelerations that torques cause.
fn has_outside_torques(scene: &Scene) -> bool {
    scene.requests.forces || scene.is_coupled() || has_pullback(scene)
}

/// Returns true if derivatives of the accelerations are requested.
fn has_pullback(scene: &Scene) -> bool {
    let gradient = scene.requests.gradient.as_ref();
    gradient.is_some_and(|gradient| gradient.accelerations)
}

/// Returns true if the scene has links with prescribed motion.
fn has_prescribed_links(scene: &Scene) -> bool {
    scene.requests.inverse_dynamics || !scene.prescribed.is_empty()
}

/// Returns the children of each link.
fn children(scene: &Scene) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); scene.links.len()];
    for (index, link) in scene.links.iter().enumerate() {
        if let Some(LinkId(parent)) = link.parent {
            children[parent].push(index);
        }
    }
    children
}

/// Returns, for each link, the number of copies below its parent that the link represents.
fn copies(scene: &Scene) -> i64 {
    match scene.layout {
        Layout::Generations { branching, .. } => branching as i64,
        Layout::Unrolled | Layout::Links => 1,
    }
}

/// Returns `name`, `name_2`, … for the pivots on one link.
fn numbered(name: &str, number: usize) -> String {
    match number {
        0 => name.to_owned(),
        _ => format!("{name}_{}", number + 1),
    }
}
