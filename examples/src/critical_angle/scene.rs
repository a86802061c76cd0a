//! The paper's pendulum with its children in phase.

use branched_pendulum::branched_pendulum;

/// The apparatus of the paper, whose children move alike, with the equations of small
/// differences between them.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction) * 2
    ],
    in_phase(child),
    emit(transverse, modes),
)]
pub struct InPhase;
