//! The measured scenes: the paper's pendulum, and full binary trees of uniform
//! rods, each generation 0.7 times as long and half as heavy as the one before.
//!
//! Each by both ways to solve for the accelerations; the names of this module
//! are those of the way that is emitted where nothing is said.

// One attribute a tree; their docs are in the attribute's output.
#![allow(missing_docs)]

/// By elimination along the tree.
pub mod factorization {
    use branched_pendulum::prelude::*;

    #[branched_pendulum(
        gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
        ],
        solve = factorization,
    )]
    pub struct Paper;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        solve = factorization,
    )]
    pub struct Tree7;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        solve = factorization,
    )]
    pub struct Tree15;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        solve = factorization,
    )]
    pub struct Tree31;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 7, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7, code = unrolled),
        solve = factorization,
    )]
    pub struct Tree127;
}

/// By articulated recursion.
pub mod recursion {
    use branched_pendulum::prelude::*;

    #[branched_pendulum(
        gravity = 9.80665,
        parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
            child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
        ],
        solve = recursion,
    )]
    pub struct Paper;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        solve = recursion,
    )]
    pub struct Tree7;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 4, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        solve = recursion,
    )]
    pub struct Tree15;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7),
        solve = recursion,
    )]
    pub struct Tree31;

    #[branched_pendulum(
        gravity = 9.80665,
        tree: generations(count = 7, branching = 2, shape = rod, mass = 0.12, length = 0.3,
            mass_ratio = 0.5, length_ratio = 0.7, code = unrolled),
        solve = recursion,
    )]
    pub struct Tree127;
}
