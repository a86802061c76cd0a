//! Trajectories per second, integrated one by one and several at once in vector registers.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use branched_pendulum::ParameterError;
use branched_pendulum::integrate::IntegrationError;
use branched_pendulum::prelude::*;

use crate::scenes::{BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters};

/// Speed of one way of integrating, on one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Name of the method, and whether it integrates several trajectories at once.
    pub way: &'static str,
    /// Trajectories a second.
    pub per_second: f64,
}

/// Order of the Taylor series: with it they are as fast as with the default order for a tolerance
/// of 1e-9, and the errors are smaller.
pub const ORDER: usize = 18;

/// Largest friction coefficient in [`friction_scan`], in N m s.
const FRICTION: f64 = 1e-3;

/// Returns releases of the paper's pendulum from 40° to 55°, with one child a thousandth of a
/// radian to the left and the other to the right of the vertical.
#[must_use]
pub fn near_threshold(count: u32) -> Vec<State<f64>> {
    let step = 15.0 / f64::from(count.max(2) - 1);
    (0..count)
        .map(|i| (40.0 + step * f64::from(i)).to_radians())
        .map(released)
        .collect()
}

/// A model, and its start.
type Release = (AbsoluteAngles<DampedBranchedDouble>, State<f64>);

/// Returns copies of the paper's pendulum with friction coefficients from zero to 1e-3 N m s in
/// every pivot, released from 50°.
///
/// # Errors
/// Does not occur, since the parameters are valid.
pub fn friction_scan(count: u32) -> Result<Vec<Release>, ParameterError> {
    let step = FRICTION / f64::from(count.max(2) - 1);
    (0..count)
        .map(|i| {
            let friction = step * f64::from(i);
            let model = DampedBranchedDouble::new(DampedBranchedDoubleParameters {
                friction_root: friction,
                friction_children: friction,
            })?;
            Ok((AbsoluteAngles(model), released(50_f64.to_radians())))
        })
        .collect()
}

fn released(angle: f64) -> State<f64> {
    State::at_rest(0.0, &[angle, 1e-3, -1e-3])
}

type Ends = Vec<Result<Solution<f64>, IntegrationError<f64>>>;

/// Names of the compared ways of integrating; the first integrates trajectories one by one.
const CONTENDERS: [&str; 4] = [
    "Dop853, one by one",
    "Dop853 in lanes",
    "Verner98 in lanes",
    "Taylor in lanes",
];

/// Measures the speed of integrating one model from every start to the time `end`. The ways of
/// integrating are timed alternately, and the fastest of several runs of each counts.
///
/// # Errors
/// Errors of the integration.
pub fn speeds(
    starts: &[State<f64>],
    end: f64,
    tolerance: f64,
    repeats: usize,
) -> Result<Vec<Speed>, IntegrationError<f64>> {
    let system = AbsoluteAngles(BranchedDouble::new());
    let methods = Methods::new(tolerance);
    let Methods { ensemble, .. } = &methods;
    let starts = || black_box(starts);
    best(
        [
            &|| ensemble.integrate(&methods.dop853, &system, starts(), end),
            &|| ensemble.integrate_in_lanes(&methods.dop853, &system, starts(), end),
            &|| ensemble.integrate_in_lanes(&methods.verner98, &system, starts(), end),
            &|| ensemble.integrate_in_lanes(&methods.taylor, &system, starts(), end),
        ],
        repeats,
    )
}

/// Measures the speed of integrating models with different parameters, each from its own start.
///
/// # Errors
/// Errors of the integration.
pub fn scan_speeds(
    releases: &[Release],
    end: f64,
    tolerance: f64,
    repeats: usize,
) -> Result<Vec<Speed>, IntegrationError<f64>> {
    let methods = Methods::new(tolerance);
    let Methods { ensemble, .. } = &methods;
    let releases = || black_box(releases);
    best(
        [
            &|| {
                ensemble.map(releases(), |_, (system, start)| {
                    methods.dop853.run(system, start, end)
                })
            },
            &|| ensemble.integrate_models_in_lanes(&methods.dop853, releases(), end),
            &|| ensemble.integrate_models_in_lanes(&methods.verner98, releases(), end),
            &|| ensemble.integrate_models_in_lanes(&methods.taylor, releases(), end),
        ],
        repeats,
    )
}

struct Methods {
    ensemble: Ensemble<'static>,
    dop853: Dop853<f64>,
    verner98: Verner98<f64>,
    taylor: Taylor<f64>,
}

impl Methods {
    fn new(tolerance: f64) -> Self {
        let options = Options::with_tolerance(tolerance);
        Self {
            ensemble: Ensemble::new().threads(NonZeroUsize::MIN),
            dop853: Dop853::new(options.clone()),
            verner98: Verner98::new(options.clone()),
            taylor: Taylor::new(options).with_order(ORDER),
        }
    }
}

fn best(
    ways: [&dyn Fn() -> Ends; CONTENDERS.len()],
    repeats: usize,
) -> Result<Vec<Speed>, IntegrationError<f64>> {
    let mut best = CONTENDERS.map(|way| Speed {
        way,
        per_second: 0.0,
    });
    for _ in 0..repeats {
        for (best, run) in best.iter_mut().zip(ways) {
            let clock = Instant::now();
            let ends = run();
            let per_second = ends.len() as f64 / clock.elapsed().as_secs_f64();
            best.per_second = best.per_second.max(per_second);
            ends.into_iter().collect::<Result<Vec<_>, _>>()?;
        }
    }
    Ok(best.to_vec())
}
