//! Taylor series: the energy of a tree over a hundred seconds is conserved to the last digits.

use branched_pendulum::prelude::*;

/// Seven rods: each carries two rods with half its mass and 0.7 times its length.
#[branched_pendulum(
    gravity = 9.80665,
    rod: generations(count = 3, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7),
    emit(energies, taylor),
)]
struct Rods;

fn main() -> Result<(), IntegrationError<f64>> {
    let rods = Rods::new();
    let angles = [0.5, 0.3, -0.2, 0.1, 0.4, -0.3, 0.2];
    let start = State::at_rest(0.0, &angles);
    let energy = |state: &State<f64>| rods.energy_of(state.positions(), state.velocities());
    for tolerance in [1e-8, 1e-12, 1e-16] {
        let method = Taylor::new(Options::with_tolerance(tolerance));
        let end = method.run(&AbsoluteAngles(&rods), &start, 100.0)?;
        let change = (energy(&end.state) / energy(&start) - 1.0).abs();
        println!(
            "tolerance {tolerance:.0e}: order {:2}, {:5} steps, energy kept to {change:.1e}",
            method.order(),
            end.report.accepted
        );
    }
    Ok(())
}
