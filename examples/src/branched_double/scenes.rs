//! The paper's apparatus, without and with friction.
//!
//! Lengths and masses were measured, the moments of inertia fitted to the three
//! eigenfrequencies (the paper, sections 4 and 5). The paper does not state g;
//! a motion that starts from rest depends on it only by the scale of time.
//!
//! There are two scenes because a model should hold no more than its scene
//! needs: most runs are without friction, and then no friction is computed.

use branched_pendulum::branched_pendulum;

/// The apparatus with ideal joints.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact)),
)]
pub struct BranchedDouble;

/// The apparatus with viscous friction in its joints.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27, friction = friction_root) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3, friction = friction_children) * 2
    ],
    emit(symmetric, transfer(exact)),
)]
pub struct DampedBranchedDouble;
