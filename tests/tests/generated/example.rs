//! The example in the docs of a model is a program that runs.

use branched_pendulum::prelude::*;
use branched_pendulum_tests::scenes::paper_expanded::Paper;

/// Lines without indentation, from after the first that is `begin` to before the next that is
/// `end`.
fn block<'t>(text: &'t str, begin: &str, end: &str) -> Vec<&'t str> {
    let lines = text
        .lines()
        .map(|line| line.trim().trim_start_matches("///").trim());
    let lines = lines.skip_while(|line| *line != begin).skip(1);
    lines.take_while(|line| *line != end).collect()
}

#[test]
fn the_example_runs() -> Result<(), IntegrationError<f64>> {
    // {
    let model = Paper::new();
    // Angles and angular velocities of parent, child_1, child_2.
    let (theta, omega) = ([0.1; 3], [0.0; 3]);
    let alpha = model.accelerations(&theta, &omega);
    let kinetic = model.kinetic_energy(&theta, &omega);
    let potential = model.potential_energy(&theta);
    // The motion from there, at 1 s and at 2 s.
    let start = State::at_rest(0.0, &theta);
    let method = Dop853::new(Options::with_tolerance(1e-12));
    let states = method.sample_to_vec(&AbsoluteAngles(&model), &start, &[1.0, 2.0])?;
    // }
    assert!(alpha[0] < 0.0 && alpha[1] == alpha[2]);
    for state in &states {
        let (theta, omega) = state.values.split_at(3);
        let [theta, omega] = [theta, omega].map(|half| [half[0], half[1], half[2]]);
        let energy = model.kinetic_energy(&theta, &omega) + model.potential_energy(&theta);
        assert!((energy - (kinetic + potential)).abs() < 1e-10 * potential);
    }
    let shown = include_str!("../../fixtures/expanded/paper.rs");
    let shown = block(shown, "```ignore", "```");
    assert_eq!(shown[..2], ["use branched_pendulum::prelude::*;", ""]);
    assert_eq!(
        shown[2..],
        block(include_str!("example.rs"), "// {", "// }")
    );
    Ok(())
}
