//! The paper's apparatus as it may really be.

use branched_pendulum::branched_pendulum;

/// The paper's apparatus with a length that may differ from the one that is assumed.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = joint, friction = friction_root) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction_children) * 2
    ],
    emit(energies, momenta, symmetric, transfer(exact)),
)]
pub struct RealApparatus;
