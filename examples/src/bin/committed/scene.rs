//! The scene from which `model.rs` was generated.

use branched_pendulum::prelude::*;

/// A rod with friction.
#[branched_pendulum(
    gravity = 9.80665,
    rod(mass = 0.2, com = 0.25, inertia = 4e-3, friction = 1e-4),
    emit(energies),
)]
pub struct Rod;
