//! First motion: a tree, its motion from a release, and its conserved energy.

use branched_pendulum::prelude::*;

/// Two equal links on one.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ],
    emit(energies),
)]
struct Tree;

fn main() -> Result<(), IntegrationError<f64>> {
    let tree = Tree::new();
    // Angles of parent and children from the downward vertical, rad; all at rest.
    let start = State::at_rest(0.0, &[0.8, 0.1, -0.1]);
    let times: Vec<f64> = (0..=10).map(f64::from).collect();
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let mut energies = Vec::new();
    let solution = method.sample(&AbsoluteAngles(&tree), &start, &times, |time, state| {
        let (theta, omega) = state.split_at(3);
        let energy = tree.energy_of(theta, omega);
        println!(
            "{time:4} s  {:8.4} {:8.4} {:8.4} rad  {energy:.12} J",
            theta[0], theta[1], theta[2]
        );
        energies.push(energy);
    })?;
    let change = energies
        .iter()
        .map(|energy| (energy / energies[0] - 1.0).abs());
    let largest = change.fold(0.0, f64::max);
    println!(
        "{} steps; energy kept to {largest:.1e}",
        solution.report.accepted
    );
    Ok(())
}
