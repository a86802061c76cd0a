//! Energy by scale, for a tree of 31 rods: the energy of the mean motion of all copies, and of the
//! differences between the copies in each generation.

use branched_pendulum::prelude::*;
use branched_pendulum::sectors::{ScaleBudget, Scales};
use branched_pendulum::system::Workspace;

/// Five generations of rods with friction in the pivots.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 5, branching = 2, shape = rod, mass = 0.2, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.7, friction = 1e-4),
    emit(energies, budget(parseval, scales)),
)]
struct Tree;

fn main() -> Result<(), IntegrationError<f64>> {
    let tree = Tree::<f64>::new();
    // Almost alike: angles of about a radian, a little different.
    let angles: Vec<f64> = (0..31).map(|link| 1.0 + 0.01 * f64::from(link)).collect();
    let (mut workspace, mut budget) = (Workspace::new(), ScaleBudget::new());
    let times: Vec<f64> = (0..=10).map(|k| 0.5 * f64::from(k)).collect();
    println!("  time (s)  energy (mJ) of scales 0 to 4, flux into scale 1 (mW), share of all");
    Dop853::new(Options::with_tolerance(1e-10)).sample(
        &AbsoluteAngles(&tree),
        &State::at_rest(0.0, &angles),
        &times,
        |time, state| {
            let (theta, omega) = state.split_at(31);
            tree.budget_by_scale(&mut workspace, time, theta, omega, &mut budget);
            let energies: Vec<String> = (0..5)
                .map(|scale| format!("{:9.3}", 1e3 * budget.energy(scale)))
                .collect();
            let sum: f64 = (0..5).map(|scale| budget.energy(scale)).sum();
            println!(
                "{time:10.1}  {}  {:9.3}  {:.12}",
                energies.join(" "),
                1e3 * budget.flux(1),
                sum / tree.energy_of(theta, omega)
            );
        },
    )?;
    Ok(())
}
