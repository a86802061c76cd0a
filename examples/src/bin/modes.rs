//! Small oscillations: frequencies and shapes of the modes of the paper's tree.

use branched_pendulum::analysis::{Modes, ModesError};
use branched_pendulum::prelude::*;

/// The apparatus of Toda and Ooshida.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(modes),
)]
struct BranchedDouble;

fn main() -> Result<(), ModesError> {
    let model = BranchedDouble::new();
    let rest = [0.0; 3];
    let modes = Modes::new(&model.mass_matrix(&rest), &model.stiffness_matrix(&rest))?;
    for (frequency, shape) in modes.frequencies_hz.iter().zip(&modes.shapes) {
        let largest = shape
            .iter()
            .fold(0.0_f64, |most, part| most.max(part.abs()));
        let parts: Vec<String> = shape
            .iter()
            .map(|part| format!("{:7.3}", part / largest))
            .collect();
        println!("{frequency:.7} Hz  parent, children: {}", parts.join(" "));
    }
    Ok(())
}
