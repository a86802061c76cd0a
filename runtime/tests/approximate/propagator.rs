//! The propagation of a frame is the matrix exponential.

use branched_pendulum::approximate::{Approximation, ForcedApproximation, Linear, LinearError};
use branched_pendulum::prelude::*;

use crate::scenes::{Free, Loops, Reed, Tree, branched};

struct Case {
    name: String,
    mass: Vec<Vec<f64>>,
    stiffness: Vec<Vec<f64>>,
    friction: Vec<Vec<f64>>,
    frame: f64,
    columns: Vec<Vec<f64>>,
}

fn cases() -> Vec<Case> {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../tests/fixtures/reference/propagators.json"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let cases: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    let rows = |value: &serde_json::Value| serde_json::from_value(value.clone()).unwrap();
    let case = |case: &serde_json::Value| Case {
        name: case["name"].as_str().unwrap().to_owned(),
        mass: rows(&case["mass"]),
        stiffness: rows(&case["stiffness"]),
        friction: rows(&case["friction"]),
        frame: case["frame"].as_f64().unwrap(),
        columns: rows(&case["columns"]),
    };
    cases.iter().map(case).collect()
}

fn linear(case: &Case) -> Linear {
    Linear::of_matrices(&case.mass, &case.stiffness, &case.friction).unwrap()
}

fn size(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .fold(0.0, |size, value| size.max(value.abs()))
}

/// Largest error of a kind of entry (of angles or rates, by angles, rates or torques),
/// relative to the largest of that kind.
fn error<T: Real>(case: &Case) -> f64 {
    let n = case.mass.len();
    let mut frames = linear(case).frames::<T>(case.frame).unwrap();
    let columns: Vec<Vec<f64>> = (0..3 * n)
        .map(|column| {
            let mut state = vec![T::ZERO; 2 * n];
            if column < 2 * n {
                state[column] = T::ONE;
                frames.step(&mut state);
            } else {
                let mut torques = vec![T::ZERO; n];
                torques[column - 2 * n] = T::ONE;
                frames.step_under(&mut state, &torques);
            }
            state.iter().map(|value| value.to_f64()).collect()
        })
        .collect();
    let mut worst = 0.0_f64;
    for by in 0..3 {
        for of in 0..2 {
            let entries =
                || (by * n..(by + 1) * n).flat_map(|j| (of * n..(of + 1) * n).map(move |i| (i, j)));
            let largest = size(entries().map(|(i, j)| case.columns[j][i]));
            let distance = size(entries().map(|(i, j)| columns[j][i] - case.columns[j][i]));
            worst = worst.max(distance / largest);
        }
    }
    worst
}

#[test]
fn a_frame_is_the_matrix_exponential_of_fifty_digits() {
    for case in cases() {
        let (double, single) = (error::<f64>(&case), error::<f32>(&case));
        assert!(double < 1e-14, "{}: {double:e}", case.name);
        assert!(single < 5e-6, "{}: {single:e}", case.name);
    }
}

#[test]
fn matrices_from_a_model_are_those_of_its_physics() {
    let case = cases()
        .into_iter()
        .find(|case| case.name == "paper")
        .unwrap();
    let model = branched(1e-4);
    let mut frames = Linear::about(&model, &[0.0; 3])
        .unwrap()
        .frames(case.frame)
        .unwrap();
    for (column, expected) in case.columns[..6].iter().enumerate() {
        let mut state = [0.0; 6];
        state[column] = 1.0;
        frames.step(&mut state);
        let largest = size(expected.iter().copied());
        for (found, expected) in state.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14 * largest, "{column}");
        }
    }
}

/// Many frames in modes lead where single steps of the state do, and torques that are
/// zero change nothing.
#[test]
fn frames_in_modes_are_those_of_states() {
    let linear = Linear::about(&Reed::new(), &[0.1, 0.5]).unwrap();
    let (mut modes, mut states) = (linear.frames(0.02).unwrap(), linear.frames(0.02).unwrap());
    let mut state = [0.3, 0.2, 1.0, -1.0];
    modes.set_state(&state);
    for _ in 0..100 {
        modes.advance();
        states.step_under(&mut state, &[0.0; 2]);
    }
    let (mut found, mut angles) = ([0.0; 4], [0.0; 2]);
    modes.state_into(&mut found);
    modes.angles_into(&mut angles);
    assert!(size(found.iter().zip(state).map(|(a, b)| a - b)) < 1e-13);
    assert_eq!(angles, found[..2]);
}

/// Constant torques hold the angles that they hold in the full model.
#[test]
fn constant_torques_lead_to_their_equilibrium() {
    let model = branched(5e-3);
    let mut frames = Linear::about(&model, &[0.0; 3])
        .unwrap()
        .frames(0.1)
        .unwrap();
    let mut state = [0.0; 6];
    let torques = [1e-6, -2e-6, 3e-6];
    for _ in 0..5000 {
        frames.step_under(&mut state, &torques);
    }
    let mut alpha = [0.0; 3];
    let (theta, omega) = state.split_at(3);
    Pendulum::accelerations_under_into(&model, 0.0, theta, omega, &torques, &mut alpha);
    assert!(
        size(omega.iter().copied()) < 1e-15 && size(alpha) < 1e-9,
        "{state:?} {alpha:?}"
    );
}

#[test]
fn equilibria_are_found() {
    let reed = Reed::new();
    let linear = Linear::about(&reed, &[0.0; 2]).unwrap();
    let mut alpha = [0.0; 2];
    reed.accelerations_into(0.0, linear.equilibrium(), &[0.0; 2], &mut alpha);
    assert!(size(alpha) < 1e-12 && linear.equilibrium()[1] > 0.3);
    // Upright is one too, of which motions grow.
    let upright = [core::f64::consts::PI; 4];
    let linear = Linear::about(&Free::new(), &upright).unwrap();
    assert_eq!(linear.frequencies_hz(), [0.0; 4]);
    let mut frames = linear.frames(0.1).unwrap();
    let mut state = [upright, [0.0; 4]].concat();
    frames.step(&mut state);
    assert!(size(state.iter().zip(upright).map(|(a, b)| a - b)) < 1e-14);
    state[3] += 1e-3;
    let before = state[3] - upright[3];
    (0..5).for_each(|_| frames.step(&mut state));
    assert!(size(state[..4].iter().zip(upright).map(|(a, b)| a - b)) > 2.0 * before);
}

/// Modes of different sectors go their own ways: a frame costs less.
#[test]
fn friction_couples_modes_of_one_sector_only() {
    let linear = Linear::about(&Tree::new(), &[0.0; 7]).unwrap();
    let mut sizes = linear
        .frames::<f64>(0.01)
        .unwrap()
        .group_sizes()
        .collect::<Vec<_>>();
    sizes.sort_unstable();
    // In phase 3, left against right 2, two pairs of twigs 1 each.
    assert_eq!(sizes, [1, 1, 2, 3]);
}

#[test]
fn trees_in_loops_have_the_same_modes() {
    let written_out = Linear::about(&Tree::new(), &[0.0; 7]).unwrap();
    let loops = Linear::about(&Loops::new(), &[0.0; 7]).unwrap();
    let pairs = written_out
        .frequencies_hz()
        .into_iter()
        .zip(loops.frequencies_hz());
    for (a, b) in pairs {
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
    assert!((written_out.fading_time() / loops.fading_time() - 1.0).abs() < 1e-10);
}

#[test]
fn what_has_no_linear_model_is_refused() {
    let one = [[1.0]];
    let skew = [[1.0, 0.5], [0.0, 1.0]];
    let unit = [[1.0, 0.0], [0.0, 1.0]];
    let refused = |result: Result<Linear, LinearError>| result.unwrap_err();
    assert_eq!(
        refused(Linear::of_matrices(&[[-1.0]], &one, &one)),
        LinearError::MassNotPositiveDefinite
    );
    assert_eq!(
        refused(Linear::of_matrices(&unit, &skew, &unit)),
        LinearError::NotSymmetric {
            matrix: "stiffness"
        }
    );
    assert_eq!(
        refused(Linear::of_matrices(
            &unit,
            &unit,
            &[[f64::NAN, 0.0], [0.0, 0.0]]
        )),
        LinearError::NotFinite
    );
    assert!(matches!(
        refused(Linear::about(&Tree::new(), &[0.0])),
        LinearError::Length {
            name: "near",
            expected: 7,
            found: 1
        }
    ));
    assert_eq!(
        refused(Linear::about(&Tree::new(), &[f64::NAN; 7])),
        LinearError::NotFinite
    );
    let none: Vec<[f64; 0]> = vec![[]; 1001];
    assert!(matches!(
        refused(Linear::of_matrices(&none, &none, &none)),
        LinearError::Size {
            links: 1001,
            most: 1000
        }
    ));
    let linear = Linear::of_matrices(&one, &one, &one).unwrap();
    for frame in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            linear.frames::<f64>(frame),
            Err(LinearError::Frame { .. })
        ));
    }
    // States of another length are answered with NaN.
    let mut frames = linear.frames(0.1).unwrap();
    let mut state = [0.0; 3];
    frames.step(&mut state);
    assert!(state.iter().all(|value: &f64| value.is_nan()));
}
