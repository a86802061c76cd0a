//! Main job (being written).
use branched_pendulum::prelude::*;

/// Paper.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies, momenta, modes, symmetric, transfer(angle = 1, amplitude = 2, exact)),
)]
pub struct BranchedDouble;

fn main() {
    let m = BranchedDouble::new();
    println!("{:?}", m.transfer_exact(&[0.5, 0.3, 0.01], &[0.01, 0.02, 0.001]));
}
