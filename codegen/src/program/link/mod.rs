//! The equations of one link in a tree, by articulated recursion (physics §10;
//! Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7): O(n) operations.
//!
//! A subtree whose pivot is accelerated by a answers with the force S a + γ − N a, with
//! a mass S that is part of the constants of its parent. From the leaves to the root
//! each link's own acceleration is eliminated from the bias force γ and the deficit N;
//! from the root to the leaves it is formed. `equations` are those of one link,
//! `tree` takes them through a tree that is written out.

mod body;
mod columns;
mod deficit;
mod entries;
mod equations;
mod functions;
mod held;
mod known;
mod lines;
mod loop_tree;
mod quantities;
mod reduced_units;
mod root;
mod scales;
mod spring_dampers;
mod strips;
mod torques;
mod tree;

pub use columns::Column;
pub use loop_tree::{
    LINK_MOTION, LineConstants, LinePotentialConstants, LoopTree, SpringDamperConstants,
    StripConstants,
};

use crate::scene::{Layout, LinkId, Scene};

/// Returns true if torques act on links that are not of their joints.
fn has_outside_torques(scene: &Scene) -> bool {
    scene.requests.forces || scene.is_coupled()
}

/// The links that hang from each link.
fn children(scene: &Scene) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); scene.links.len()];
    for (index, link) in scene.links.iter().enumerate() {
        if let Some(LinkId(parent)) = link.parent {
            children[parent].push(index);
        }
    }
    children
}

/// How many links each link of the scene that hangs from another stands for there.
fn copies(scene: &Scene) -> i64 {
    match scene.layout {
        Layout::Generations { branching, .. } => branching as i64,
        _ => 1,
    }
}

/// `name`, `name_2`, … for the pivots on one link.
fn numbered(name: &str, number: usize) -> String {
    match number {
        0 => name.to_owned(),
        _ => format!("{name}_{}", number + 1),
    }
}
