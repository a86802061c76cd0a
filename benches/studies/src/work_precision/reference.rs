//! Reference trajectories: for the paper's apparatus those of
//! `tests/fixtures/reference/trajectories.json`; for seven rods, which the file does not contain,
//! Taylor series with twice the number of digits.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;

use crate::scenes::Rods;
use branched_pendulum_frame::Failure;

/// Contents of the file when the program was built.
const FILE: &str = include_str!("../../../../tests/fixtures/reference/trajectories.json");

/// The tree of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tree {
    /// The paper's apparatus.
    Paper,
    /// Seven rods.
    Rods,
}

/// A motion from rest, with its state at a given time.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Name of the problem in the charts.
    pub name: &'static str,
    /// The tree that moves.
    pub tree: Tree,
    /// Angles at the start, rad.
    pub start: Vec<f64>,
    /// The time, s.
    pub end: f64,
    /// Angles (rad) and velocities (rad/s) at that time.
    pub expected: Vec<f64>,
}

/// Returns the problems whose duration (s) is one of `ends`: regular motion for a short and a long
/// time; chaotic motion near the threshold, for as long as `f64` predicts it well and for as long
/// as it predicts it at all; and seven rods.
///
/// # Errors
/// [`Failure::Integration`]if the reference of the rods could not be computed.
pub fn problems(ends: &[f64]) -> Result<Vec<Problem>, Failure> {
    let mut problems = papers();
    problems.retain(|problem| ends.contains(&problem.end));
    for (name, end) in [("seven rods, 10 s", 10.0), ("seven rods, 100 s", 100.0)] {
        if ends.contains(&end) {
            problems.push(Problem {
                name,
                tree: Tree::Rods,
                start: RODS.to_vec(),
                end,
                expected: rods_at(end, TOLERANCE)?,
            });
        }
    }
    Ok(problems)
}

/// The problems of the file.
pub fn papers() -> Vec<Problem> {
    let regular = [0.3, 1e-3, -1e-3];
    let threshold = [47.8_f64.to_radians(), 1e-3, -1e-3];
    let paper = |name, key, start: [f64; 3], time: &str| Problem {
        name,
        tree: Tree::Paper,
        start: start.to_vec(),
        end: time.parse().unwrap_or(f64::NAN),
        expected: ["theta", "omega"]
            .into_iter()
            .flat_map(|quantity| numbers(FILE, &[key, "t", time, quantity]))
            .collect(),
    };
    vec![
        paper("regular, 10 s", "regular", regular, "10"),
        paper("regular, 100 s", "regular", regular, "100"),
        paper("near threshold, 10 s", "near-threshold", threshold, "10"),
        paper("near threshold, 20 s", "near-threshold", threshold, "20"),
    ]
}

/// Initial angles of the seven rods in rad, ordered as the root, then each child followed by its
/// own children.
pub const RODS: [f64; 7] = [0.08, 0.005, 0.002, -0.001, -0.005, 0.0015, -0.003];

/// Tolerance of the rods' reference.
const TOLERANCE: f64 = 1e-24;

/// Computes angles (rad) and velocities (rad/s) of the rods at the time `end` (s), from Taylor
/// series of the emitted equations with 31 digits (double-double numbers).
///
/// # Errors
/// [`Failure::Integration`].
pub fn rods_at(end: f64, tolerance: f64) -> Result<Vec<f64>, Failure> {
    let model = Rods::<Double>::default();
    let start = State::at_rest(Double::from_f64(0.0), &RODS.map(Double::from_f64));
    let method = Taylor::new(Options::with_tolerance(Double::from_f64(tolerance)));
    let ode = AbsoluteAngles(&model);
    let end = Double::from_f64(end);
    let solution = method
        .run(&ode, &start, end)
        .map_err(|error| Failure::integration(RODS[0].to_degrees(), error))?;
    let values = solution.state.values.iter();
    Ok(values.map(|value| value.high()).collect())
}

/// Returns the numbers of the array under the last of `keys`; each key is searched for after the
/// previous one. `None` if a key is missing. The file contains its numbers as strings.
fn numbers(text: &str, keys: &[&str]) -> Vec<f64> {
    let behind = keys.iter().try_fold(text, |text, key| {
        let quoted = format!("\"{key}\":");
        text.find(&quoted).map(|at| &text[at + quoted.len()..])
    });
    let array = behind.and_then(|text| text.split_once(']'));
    array.map_or_else(Vec::new, |(array, _)| {
        let parts = array.split('"');
        parts.filter_map(|part| part.parse().ok()).collect()
    })
}
