//! Trajectories a second, one by one and in lanes.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use branched_pendulum::ParameterError;
use branched_pendulum::integrate::IntegrationError;
use branched_pendulum::prelude::*;

use crate::scenes::{BranchedDouble, DampedBranchedDouble, DampedBranchedDoubleParameters};

/// How fast a way to integrate is, on one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// The method, and how it runs.
    pub way: &'static str,
    /// Trajectories a second.
    pub per_second: f64,
}

/// Order of the Taylor series: as fast as the order that the tolerance of 1e-9 calls
/// for by default, with smaller errors.
pub const ORDER: usize = 18;

/// Largest friction of [`friction_scan`], N m s.
const FRICTION: f64 = 1e-3;

/// Releases of the paper's pendulum from 40° to 55°, its children a thousandth of
/// a radian to both sides of the vertical.
#[must_use]
pub fn near_threshold(count: u32) -> Vec<State<f64>> {
    let step = 15.0 / f64::from(count.max(2) - 1);
    (0..count)
        .map(|i| (40.0 + step * f64::from(i)).to_radians())
        .map(released)
        .collect()
}

/// A model of its own, and where it starts.
type Release = (AbsoluteAngles<DampedBranchedDouble>, State<f64>);

/// Paper's pendulums with friction from zero to 1e-3 N m s in every pivot, released
/// from 50°.
///
/// # Errors
/// None: the parameters are possible.
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

/// The ways that are compared; the first is one by one.
const WAYS: [&str; 4] = [
    "Dop853, one by one",
    "Dop853 in lanes",
    "Verner98 in lanes",
    "Taylor in lanes",
];

/// One model from every start to the time `end`, in the ways in turn: the best of
/// several runs of each.
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

/// Speeds for models that differ, each from its own start.
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
    ways: [&dyn Fn() -> Ends; WAYS.len()],
    repeats: usize,
) -> Result<Vec<Speed>, IntegrationError<f64>> {
    let mut best = WAYS.map(|way| Speed {
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
