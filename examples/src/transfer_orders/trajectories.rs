//! Relative error along exact motions.

use std::ops::ControlFlow;

use branched_pendulum::integrate::DenseError;
use branched_pendulum::prelude::{
    DenseStep, Dop853, Options, State, SymmetricCoordinates, Tolerance,
};

use super::error_curve::{AMPLITUDES, Point, Sums, logarithmic};
use super::forms::{Apparatus, Motion, Powers};
use crate::branched_double::Failure;

/// Initial angle θ_1(0), degrees: of the two that the paper compares, the one
/// from which θ_d grows.
pub const ANGLE_DEG: f64 = 47.8;

/// Number of releases. While θ_d is small it grows by the same factors from any
/// θ_d(0), so that few releases would show each amplitude at few instants of
/// the in-phase motion.
pub const RELEASES: usize = 49;

/// Smallest and largest θ_d(0) of the releases, rad, spread with equal ratios.
pub const DISTURBANCES: [f64; 2] = [1e-4, 1.0];

/// Time followed after each release, s: the span of the paper's spectrum.
pub const DURATION: f64 = 32.0;

/// Samples per second.
const RATE: f64 = 1000.0;

/// Relative error by amplitude at the instant, in `count` bins with equal
/// ratios over [`AMPLITUDES`]; bins without samples are left out.
///
/// # Errors
/// [`Failure::Integration`].
pub fn along_trajectories(count: usize) -> Result<Vec<Point>, Failure> {
    let [low, high] = AMPLITUDES;
    let per_bin = (high / low).ln() / count as f64;
    let mut bins = vec![Sums::default(); count];
    for disturbance in logarithmic(DISTURBANCES, RELEASES) {
        follow(disturbance, |motion| {
            let bin = ((motion.amplitude() / low).ln() / per_bin).floor();
            // Below the range it is negative, which the cast would make zero.
            if bin >= 0.0
                && let Some(sums) = bins.get_mut(bin as usize)
            {
                sums.add(&Powers::at(motion));
            }
        })?;
    }
    let centre = |bin: usize| low * (per_bin * (bin as f64 + 0.5)).exp();
    let bins = bins.iter().enumerate();
    Ok(bins
        .filter_map(|(bin, sums)| sums.point(centre(bin)))
        .collect())
}

/// Calls `visit` with the motion at even times after one release from rest.
fn follow(disturbance: f64, mut visit: impl FnMut(&Motion)) -> Result<(), Failure> {
    let failed = |message: String| Failure::Integration {
        angle_deg: ANGLE_DEG,
        source: message.into(),
    };
    let model = Apparatus::new();
    let start = State::at_rest(0.0, &[ANGLE_DEG.to_radians(), 0.0, disturbance]);
    let options = Options {
        // θ_d keeps its relative accuracy while it is small.
        absolute: Tolerance::Uniform(1e-15),
        ..Options::with_tolerance(1e-12)
    };
    let mut next = 0_u64;
    let mut dense_error = None;
    Dop853::new(options)
        .integrate(
            &SymmetricCoordinates(&model),
            &start,
            DURATION,
            |step| match sample(step, &mut next, &mut visit) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    dense_error = Some(error);
                    ControlFlow::Break(())
                }
            },
        )
        .map_err(|error| failed(error.to_string()))?;
    dense_error.map_or(Ok(()), |error| Err(failed(error.to_string())))
}

/// Visits the even times within one step, from the sample number `next` on.
fn sample(
    step: &mut DenseStep<'_, f64>,
    next: &mut u64,
    visit: &mut impl FnMut(&Motion),
) -> Result<(), DenseError<f64>> {
    let mut values = [0.0; 6];
    loop {
        let time = *next as f64 / RATE;
        if time > step.end_time() {
            return Ok(());
        }
        step.eval(time, &mut values)?;
        let [theta_1, theta_m, theta_d, omega_1, omega_m, omega_d] = values;
        visit(&Motion {
            coordinates: [theta_1, theta_m, theta_d],
            rates: [omega_1, omega_m, omega_d],
        });
        *next += 1;
    }
}
