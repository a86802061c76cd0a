//! A tree of a million links.

use branched_pendulum::prelude::*;
use branched_pendulum_compiler_tests::random::Random;

/// 2²⁰ − 1 links.
#[branched_pendulum(
    gravity = 9.80665,
    tree: generations(count = 20, branching = 2, shape = rod, mass = 0.12, length = 0.3,
        mass_ratio = 0.5, length_ratio = 0.9),
    emit(energies),
)]
struct Million;

#[test]
fn a_million_links_keep_their_energy() {
    let model = Million::<f64>::new();
    let n = Million::LINKS;
    assert_eq!(n, 1_048_575);
    let mut random = Random::new(5);
    let theta: Vec<f64> = (0..n).map(|_| random.array::<1>(-1.0, 1.0)[0]).collect();
    let start = State::at_rest(0.0, &theta);
    let energy = |state: &State<f64>| {
        model.kinetic_energy(state.positions(), state.velocities())
            + model.potential_energy(state.positions())
    };
    let end = Rk4::new(2.5e-4)
        .run(&AbsoluteAngles(&model), &start, 0.02)
        .unwrap()
        .state;
    let moved = model.kinetic_energy(end.positions(), end.velocities());
    let change = energy(&end) - energy(&start);
    println!("kinetic energy {moved:e} J, change of the whole {change:e} J");
    assert!(moved > 0.01, "{moved:e}");
    assert!(change.abs() < 1e-9 * moved, "{change:e}");
}
