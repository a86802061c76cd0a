//! The motions, each from rest and for ten seconds, and where they end.

use core::ops::ControlFlow;
use std::error::Error;

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::TaylorPendulum;

use super::scenes::Seven;
use crate::work_precision::reference;

/// Seconds.
pub const END: f64 = 10.0;

/// A motion of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Name, as the table shows it.
    pub name: &'static str,
    /// Angles at the start, rad.
    pub start: Vec<f64>,
    /// Angles (rad) and velocities (rad/s) at the end.
    pub expected: Vec<f64>,
}

/// The paper's pendulum, regular and near its threshold, with the committed
/// reference trajectories.
pub fn of_three_links() -> [Problem; 2] {
    let known = reference::problems();
    let short = |key: &'static str| {
        let found = known
            .iter()
            .find(|problem| problem.name == format!("{key}, 10 s"));
        Problem {
            name: key,
            start: found.map_or_else(Vec::new, |problem| problem.start.to_vec()),
            expected: found.map_or_else(Vec::new, |problem| problem.expected.clone()),
        }
    };
    [short("regular"), short("near threshold")]
}

/// Seven rods, regular. Where they end is computed in 32 digits.
///
/// # Errors
/// Those of the integration.
pub fn of_seven_links() -> Result<Problem, Box<dyn Error>> {
    let start = vec![0.08, 0.005, 0.002, -0.001, -0.005, 0.0015, -0.003];
    let expected = in_32_digits(&Seven::<Double>::default(), &start)?;
    Ok(Problem {
        name: "seven rods",
        start,
        expected,
    })
}

/// The state at the end, by the Taylor series in double-double numbers.
fn in_32_digits<P: TaylorPendulum<Double>>(
    model: &P,
    start: &[f64],
) -> Result<Vec<f64>, Box<dyn Error>> {
    let start: Vec<Double> = start.iter().copied().map(Double::from_f64).collect();
    let zero = Double::from_f64(0.0);
    let solution = Taylor::new(Options::with_tolerance(Double::from_f64(1e-22))).integrate(
        &AbsoluteAngles(model),
        &State::at_rest(zero, &start),
        Double::from_f64(END),
        |_| ControlFlow::Continue(()),
    )?;
    let values = solution.state.values.iter();
    Ok(values.map(|value| value.to_f64()).collect())
}
