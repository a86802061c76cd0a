//! The template is what the first page of the book shows, and runs changed as it says.

use branched_pendulum::prelude::*;

/// The template's tree with three children and friction.
#[branched_pendulum(
    gravity = 9.80665,
    parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
        child(mass = m, com = 0.043, inertia = 0.516e-3, friction = 1e-5) * 3
    ],
    emit(energies, symmetric),
)]
struct BranchedTriple;

#[test]
fn a_third_child_runs_from_the_page_s_start() {
    let page = include_str!("../../../docs/tutorials/first-crate.md");
    let line = "let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 0.0, 0.01, 0.0]);";
    assert!(page.contains(line));
    let start = State::at_rest(0.0, &[47.8_f64.to_radians(), 0.0, 0.01, 0.0]);
    let model = BranchedTriple::new(BranchedTripleParameters { m: 0.2 }).unwrap();
    let mut differences = Vec::new();
    let solution = Dop853::new(Options::with_tolerance(1e-12))
        .sample(
            &SymmetricCoordinates(&model),
            &start,
            &[0.0, 5.0, 10.0],
            |_, state| {
                differences.push(state[2]);
            },
        )
        .unwrap();
    assert_eq!(differences[0], 0.01);
    let energy = |state: &State<f64>| {
        let (q, v) = (state.positions(), state.velocities());
        let (q, v) = (q.try_into().unwrap(), v.try_into().unwrap());
        let (q, v) = (model.from_symmetric(q), model.from_symmetric(v));
        model.kinetic_energy(&q, &v) + model.potential_energy(&q)
    };
    // Friction takes some of it, and nothing else does.
    let rest = model.potential_energy(&[0.0; 4]);
    let left = (energy(&solution.state) - rest) / (energy(&start) - rest);
    assert!((0.9..1.0).contains(&left), "{left}");
}

#[test]
fn the_first_page_shows_the_template() {
    let page = include_str!("../../../docs/tutorials/first-crate.md");
    assert!(
        page.contains("```rust,ignore\n{{#include ../../examples/template/src/main.rs}}\n```\n")
    );
    let manifest = include_str!("../../template/Cargo.toml");
    assert!(manifest.contains("[profile.dev]\nopt-level = 1\n"));
    for page in [page, include_str!("../../../README.md")] {
        assert!(page.contains("[profile.dev]\nopt-level = 1 "));
    }
}
