//! The measured scenes: the paper's pendulum, and full binary trees of uniform
//! rods, each generation 0.7 times as long and half as heavy as the one before.

// One attribute a tree; their docs are in the attribute's output.
#![allow(missing_docs)]

/// Declares all scenes, compiled with one of the methods of solving for the accelerations.
macro_rules! scenes {
    ($solve:ident: $($tree:ident $generations:literal)*) => {
        pub mod $solve {
            use branched_pendulum::prelude::*;

            #[branched_pendulum(
                gravity = 9.80665,
                parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
                    child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
                ],
                solve = $solve,
            )]
            pub struct Paper;

            $(
                #[branched_pendulum(
                    gravity = 9.80665,
                    tree: generations(count = $generations, branching = 2, shape = rod, mass = 0.12,
                        length = 0.3, mass_ratio = 0.5, length_ratio = 0.7, code = unrolled),
                    solve = $solve,
                )]
                pub struct $tree;
            )*
        }
    };
}

// By elimination along the tree, and by articulated recursion.
scenes!(factorization: Tree7 3 Tree15 4 Tree31 5 Tree127 7);
scenes!(recursion: Tree7 3 Tree15 4 Tree31 5 Tree127 7);
