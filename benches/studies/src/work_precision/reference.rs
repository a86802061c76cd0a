//! Reference trajectories: for the paper's apparatus those of
//! `tests/fixtures/reference/trajectories.json`; for rods, which the file does not contain, Taylor
//! series with twice the number of digits.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorPendulum;

use crate::scenes::{FifteenRods, Rods, ThirtyOneRods};
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
    /// Fifteen rods.
    FifteenRods,
    /// Thirty-one rods.
    ThirtyOneRods,
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

/// Returns the problems of small trees: regular motion for a short and a long time; chaotic motion
/// near the threshold, for as long as `f64` predicts it well and for as long as it predicts it at
/// all; and seven rods.
///
/// # Errors
/// [`Failure::Integration`] if the reference of the rods could not be computed.
pub fn problems() -> Result<Vec<Problem>, Failure> {
    let (tree, model) = (Tree::Rods, Rods::<Double>::default());
    let mut problems = papers();
    problems.push(rods("seven rods, 10 s", tree, &model, &RODS, 10.0)?);
    problems.push(rods("seven rods, 100 s", tree, &model, &RODS, 100.0)?);
    Ok(problems)
}

/// Returns the problems of larger trees: motions of fifteen and of thirty-one rods.
///
/// # Errors
/// [`Failure::Integration`] if a reference could not be computed.
pub fn large_problems() -> Result<Vec<Problem>, Failure> {
    let angle = |link: usize| match link {
        0 => 0.08,
        _ => 0.005 * ((7 * link % 5) as f64 - 2.0),
    };
    let start: Vec<f64> = (0..31).map(angle).collect();
    let (fifteen, thirty_one) = (
        FifteenRods::<Double>::default(),
        ThirtyOneRods::<Double>::default(),
    );
    let (half, whole) = (&start[..15], &start[..]);
    Ok(vec![
        rods(
            "fifteen rods, 10 s",
            Tree::FifteenRods,
            &fifteen,
            half,
            10.0,
        )?,
        rods(
            "thirty-one rods, 10 s",
            Tree::ThirtyOneRods,
            &thirty_one,
            whole,
            10.0,
        )?,
    ])
}

/// Returns releases of the paper's pendulum from 40° to 55°, with one child a thousandth of a
/// radian to the left and the other to the right of the vertical.
#[must_use]
pub fn near_threshold(count: u32) -> Vec<State<f64>> {
    let step = 15.0 / f64::from(count.max(2) - 1);
    (0..count)
        .map(|i| (40.0 + step * f64::from(i)).to_radians())
        .map(|angle| State::at_rest(0.0, &[angle, 1e-3, -1e-3]))
        .collect()
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
pub const TOLERANCE: f64 = 1e-24;

fn rods<P: TaylorPendulum<Double>>(
    name: &'static str,
    tree: Tree,
    model: &P,
    start: &[f64],
    end: f64,
) -> Result<Problem, Failure> {
    Ok(Problem {
        name,
        tree,
        start: start.to_vec(),
        end,
        expected: end_of(model, start, end, TOLERANCE)?,
    })
}

/// Computes angles (rad) and velocities (rad/s) of a tree at the time `end` (s) after a release from
/// rest, from Taylor series of the emitted equations with 31 digits (double-double numbers).
///
/// # Errors
/// [`Failure::Integration`].
pub fn end_of<P: TaylorPendulum<Double>>(
    model: &P,
    start: &[f64],
    end: f64,
    tolerance: f64,
) -> Result<Vec<f64>, Failure> {
    let wide: Vec<Double> = start.iter().copied().map(Double::from_f64).collect();
    let state = State::at_rest(Double::from_f64(0.0), &wide);
    let method = Taylor::new(Options::with_tolerance(Double::from_f64(tolerance)));
    let solution = method
        .run(&AbsoluteAngles(model), &state, Double::from_f64(end))
        .map_err(|error| Failure::integration(start[0].to_degrees(), error))?;
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
