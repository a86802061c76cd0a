//! Times and errors of one method at many tolerances, and the interpolated time for a given error.

use std::hint::black_box;
use std::time::Instant;

use branched_pendulum::integrate::IntegrationError;
use branched_pendulum::prelude::*;

use crate::work_precision::reference::Problem;

/// Errors for which the table shows the time.
pub const ERRORS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-14];

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Largest error of all angles (rad) and velocities (rad/s) at the end.
    pub error: f64,
    /// Shortest time of several, µs.
    pub micros: f64,
}

/// Runs a method at three tolerances per decade from 1e-2 to 1e-16, `repeats` times each.
///
/// # Errors
/// Errors of the integration.
pub fn points<O: Ode<f64>, M: Integrator<f64, O>>(
    ode: &O,
    problem: &Problem,
    repeats: usize,
    method: impl Fn(f64) -> M,
) -> Result<Vec<Point>, IntegrationError<f64>> {
    let (start, end) = (State::at_rest(0.0, &problem.start), problem.end);
    (6..=48)
        .map(|third| {
            let method = method(10.0_f64.powf(f64::from(-third) / 3.0));
            let mut point = Point {
                error: f64::NAN,
                micros: f64::INFINITY,
            };
            for _ in 0..repeats {
                let clock = Instant::now();
                let solution = method.run(ode, black_box(&start), end)?;
                point.micros = point.micros.min(clock.elapsed().as_secs_f64() * 1e6);
                let pairs = solution.state.values.iter().zip(&problem.expected);
                point.error = pairs.fold(0.0, |worst, (a, b)| (a - b).abs().max(worst));
            }
            Ok(point)
        })
        .collect()
}

/// Returns the shortest time at which this error was reached; `None` if it was not reached.
pub fn time_for(points: &[Point], error: f64) -> Option<f64> {
    let reached = points.iter().filter(|point| point.error <= error);
    reached.map(|point| point.micros).reduce(f64::min)
}
