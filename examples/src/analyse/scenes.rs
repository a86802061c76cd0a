//! The paper's apparatus as it may really be, and a chain all of whose properties are parameters.

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
    upper(mass = mass_1, com = com_1, inertia = inertia_1, joint = joint_1,
        friction(viscous = viscous_1, coulomb = coulomb_1, width = 0.05),
        drag(quadratic = quadratic_1, width = 0.05)) [
        lower(mass = mass_2, com = com_2, inertia = inertia_2,
            friction(viscous = viscous_2, coulomb = coulomb_2, width = 0.05),
            drag(quadratic = quadratic_2, width = 0.05))
    ],
    emit(energies, modes),
)]
pub struct Chain;
