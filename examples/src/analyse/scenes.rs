//! Pendulums whose constants are measured with doubt, or on other apparatus.

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

/// A chain of two links.
#[branched_pendulum(
    gravity = gravity,
    upper(mass = upper_mass, com = upper_com, inertia = upper_inertia, joint = upper_joint, friction = upper_friction) [
        lower(mass = lower_mass, com = lower_com, inertia = lower_inertia, friction = lower_friction)
    ],
    emit(energies),
)]
pub struct DoublePendulum;
