//! Trees, with little and with much symmetry.

use branched_pendulum::prelude::*;

/// The paper's pendulum with friction.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    emit(energies, forces),
)]
pub struct Branched;

/// The same pendulum with children in phase, but for small differences.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    in_phase(child),
    emit(small, forces),
)]
pub struct BranchedSmall;

/// A binary tree of three generations.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 2e-3, friction_ratio = 0.3),
    emit(energies, forces),
)]
pub struct Tree;

/// The same tree with copies in phase, but for small differences.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 2e-3, friction_ratio = 0.3),
    in_phase(tree),
    emit(small, forces),
)]
pub struct TreeSmall;

/// The same tree in loops.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 2e-3, friction_ratio = 0.3, code = loops),
    emit(energies),
)]
pub struct Loops;

/// A reed that stands up and leans, with a stiff twig on one side.
#[branched_pendulum(
    gravity = -9.80665,
    stem: rod(mass = 0.1, length = 0.3, spring = 0.6, friction = 5e-3) [
        twig: rod(mass = 0.02, length = 0.2, spring = 0.1, rest = 0.7, friction = 1e-3, drag = 1e-4)
    ],
    emit(energies),
)]
pub struct Reed;

/// Every link on its own, without friction.
#[branched_pendulum(
    gravity = 9.80665,
    first: rod(mass = 0.2, length = 0.4) [
        second: rod(mass = 0.1, length = 0.3) [
            third: rod(mass = 0.05, length = 0.25),
            fourth: point(mass = 0.02, length = 0.1)
        ]
    ],
    emit(energies),
)]
pub struct Free;

pub(crate) fn branched(friction: f64) -> Branched {
    Branched::new(BranchedParameters { friction }).unwrap()
}
