//! Trees of `scenes.py`; `cargo branched-pendulum expand` generates their code.

use branched_pendulum::prelude::*;

/// The paper's apparatus.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(taylor),
)]
pub struct BranchedDouble;

/// Seven rods.
#[branched_pendulum(
    gravity = 9.80665,
    rod: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    emit(taylor),
)]
pub struct Rods;

/// Thirty-one rods.
#[branched_pendulum(
    gravity = 9.80665,
    rod: generations(count = 5, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
)]
pub struct ThirtyOneRods;

/// A reed: three rods on stiff springs, with friction that damps them within milliseconds.
#[branched_pendulum(
    gravity = 9.80665,
    low: rod(mass = 0.05, length = 0.1, spring = 2e3, friction = 2) [
        middle: rod(mass = 0.02, length = 0.1, spring = 1e3, friction = 1) [
            top: rod(mass = 0.01, length = 0.1, friction = 1e-4)
        ]
    ],
)]
pub struct Reed;
