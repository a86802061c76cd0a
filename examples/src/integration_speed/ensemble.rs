//! Trajectories a second, one by one and in lanes.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use branched_pendulum::ensemble::Ensemble;
use branched_pendulum::integrate::IntegrationError;
use branched_pendulum::prelude::*;

use crate::solvers::scenes::Ideal;

/// Trajectories a second on one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speeds {
    /// `Dop853`, one by one.
    pub plain: f64,
    /// `Dop853` in the lanes of vector registers.
    pub lanes: f64,
    /// `Taylor` there.
    pub series: f64,
}

/// Order of [`Speeds::series`]: as fast as the order that the tolerance of 1e-9 calls
/// for by default, with smaller errors.
pub const ORDER: usize = 18;

/// Releases of the paper's pendulum from 40° to 55°, its children a thousandth of
/// a radian to both sides of the vertical.
#[must_use]
pub fn near_threshold(count: u32) -> Vec<State<f64>> {
    let step = 15.0 / f64::from(count.max(2) - 1);
    (0..count)
        .map(|i| (40.0 + step * f64::from(i)).to_radians())
        .map(|angle| State::at_rest(0.0, &[angle, 1e-3, -1e-3]))
        .collect()
}

/// The best of several runs to the time `end`, the three ways in turn.
///
/// # Errors
/// Those of the integration.
pub fn speeds(
    starts: &[State<f64>],
    end: f64,
    tolerance: f64,
    repeats: usize,
) -> Result<Speeds, IntegrationError<f64>> {
    let model = Ideal::new();
    let ensemble = Ensemble::new().threads(NonZeroUsize::MIN);
    let method = Dop853::new(Options::with_tolerance(tolerance));
    let series = Taylor::new(Options::with_tolerance(tolerance)).with_order(ORDER);
    let mut best = Speeds {
        plain: 0.0,
        lanes: 0.0,
        series: 0.0,
    };
    let per_second = |clock: Instant| starts.len() as f64 / clock.elapsed().as_secs_f64();
    for _ in 0..repeats {
        let clock = Instant::now();
        let ends = ensemble.integrate(&method, &AbsoluteAngles(&model), black_box(starts), end);
        best.plain = best.plain.max(per_second(clock));
        ends.into_iter().collect::<Result<Vec<_>, _>>()?;
        let clock = Instant::now();
        let ends = ensemble.integrate_in_lanes(&method, &model, black_box(starts), end);
        best.lanes = best.lanes.max(per_second(clock));
        ends.into_iter().collect::<Result<Vec<_>, _>>()?;
        let clock = Instant::now();
        let ends = ensemble.integrate_in_lanes(&series, &model, black_box(starts), end);
        best.series = best.series.max(per_second(clock));
        ends.into_iter().collect::<Result<Vec<_>, _>>()?;
    }
    Ok(best)
}
