//! Error, time and evaluations.

use std::time::{Duration, Instant};

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;

use super::reference::{Problem, Tree};
use crate::scenes::{BranchedDouble, Rods};
use crate::solvers::configured;
use branched_pendulum_frame::Progress;

/// The methods that are compared.
pub const METHODS: [Method; 8] = [
    Method::Rk4,
    Method::Dopri5,
    Method::Dop853,
    Method::Verner98,
    Method::Taylor,
    Method::Gauss(GaussOrder::Four),
    Method::Gauss(GaussOrder::Six),
    Method::Gauss(GaussOrder::Eight),
];

/// One run of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// The method.
    pub method: Method,
    /// Tolerance or step of the method.
    pub setting: f64,
    /// Largest error at the end, rad or rad/s.
    pub error: f64,
    /// Time for the run, µs: the shortest of several.
    pub microseconds: f64,
    /// Evaluations of the right-hand side; of Taylor series, orders of their
    /// coefficients.
    pub evaluations: u64,
}

/// Tolerances or steps of a method, from loose to tight.
fn settings(method: Method) -> Vec<f64> {
    let steps = |longest: f64, count: i32| {
        let halves = |k| longest * 0.5_f64.powf(0.5 * f64::from(k));
        (0..count).map(halves).collect()
    };
    let tolerances = |last: i32| {
        let tolerance = |k| 10.0_f64.powf(-0.5 * f64::from(k));
        (6..=last).map(tolerance).collect()
    };
    match method {
        Method::Taylor => tolerances(32),
        _ if method.is_adaptive() => tolerances(28),
        Method::Rk4 => steps(0.02, 14),
        _ => steps(0.08, 11),
    }
}

/// Measures a problem with every method, as one part of `progress`; runs that fail
/// are left out.
pub fn measure(problem: &Problem, progress: &Progress) -> Vec<Measurement> {
    match problem.tree {
        Tree::Paper => measure_on(&AbsoluteAngles(&BranchedDouble::new()), problem, progress),
        Tree::Rods => measure_on(&AbsoluteAngles(&Rods::new()), problem, progress),
    }
}

fn measure_on(
    ode: &impl TaylorOde<f64>,
    problem: &Problem,
    progress: &Progress,
) -> Vec<Measurement> {
    let start = State::at_rest(0.0, &problem.start);
    let mut all = Vec::new();
    for method in METHODS {
        progress.begin(&format!("{}: {}", problem.name, method.title()));
        let settings = settings(method);
        for &setting in &settings {
            progress.advance(1.0 / (METHODS.len() * settings.len()) as f64);
            let run = || {
                let observer = |_: &mut DenseStep<'_, f64>| ControlFlow::Continue(());
                configured(method, setting).integrate(ode, &start, problem.end, observer)
            };
            let Ok(solution) = run() else {
                continue;
            };
            let both = solution.state.values.iter().zip(&problem.expected);
            let error = both.fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
            all.push(Measurement {
                method,
                setting,
                error,
                microseconds: shortest(run),
                evaluations: solution.report.evaluations,
            });
        }
    }
    all
}

/// The shortest time of repeated runs, µs: what disturbs a run only lengthens
/// it.
fn shortest<R>(run: impl Fn() -> R) -> f64 {
    let (mut best, mut spent, mut runs) = (Duration::MAX, Duration::ZERO, 0);
    while runs < 3 || (spent < Duration::from_millis(30) && runs < 1000) {
        let begin = Instant::now();
        std::hint::black_box(run());
        let time = begin.elapsed();
        best = best.min(time);
        spent += time;
        runs += 1;
    }
    best.as_secs_f64() * 1e6
}

/// Time that an error costs with a method, interpolated between its runs, µs;
/// none where none of them is as good.
pub fn time_to_error(runs: &[Measurement], method: Method, error: f64) -> Option<f64> {
    let own: Vec<_> = runs.iter().filter(|run| run.method == method).collect();
    let good = own.iter().position(|run| run.error <= error)?;
    let (after, before) = (own[good], own.get(good.wrapping_sub(1)));
    let share = before.map(|before| {
        let part = (before.error / error).ln() / (before.error / after.error).ln();
        before.microseconds * (after.microseconds / before.microseconds).powf(part)
    });
    Some(share.unwrap_or(after.microseconds))
}

/// Largest relative error of the energy in each of a hundred parts of 1,000 s
/// of regular motion.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyDrift {
    /// The method and its setting, as the chart names them.
    pub name: String,
    /// End of each part, s.
    pub times: Vec<f64>,
    /// Error in each part.
    pub errors: Vec<f64>,
    /// Evaluations of the whole run.
    pub evaluations: u64,
}

/// Follows the energy with every method at one setting each, as one part of
/// `progress`.
///
/// # Errors
/// As the methods'.
pub fn energy_drifts(progress: &Progress) -> Result<Vec<EnergyDrift>, IntegrationError<f64>> {
    let model = BranchedDouble::new();
    let start = State::at_rest(0.0, &[0.3, 1e-3, -1e-3]);
    let energy = |state: &[f64]| {
        let (theta, omega) = state.split_at(3);
        model.kinetic_energy_of(theta, omega) + model.potential_energy_of(theta)
    };
    let initial: f64 = energy(&start.values);
    let cases = [
        (Method::Rk4, 0.005),
        (Method::Dopri5, 1e-10),
        (Method::Dop853, 1e-12),
        (Method::Verner98, 1e-13),
        (Method::Taylor, 1e-16),
        (Method::Gauss(GaussOrder::Four), 0.02),
        (Method::Gauss(GaussOrder::Eight), 0.01),
    ];
    let run = |(method, setting): (Method, f64)| {
        progress.begin(&format!("energy: {}", method.title()));
        let mut errors = vec![0.0_f64; 100];
        let observer = |step: &mut DenseStep<'_, f64>| {
            let part = ((step.end_time() / 10.0) as usize).min(99);
            errors[part] = errors[part].max((energy(step.end()) / initial - 1.0).abs());
            ControlFlow::Continue(())
        };
        let ode = AbsoluteAngles(&model);
        let solution = configured(method, setting).integrate(&ode, &start, 1000.0, observer)?;
        progress.advance(1.0 / cases.len() as f64);
        let unit = if method.is_adaptive() {
            "tolerance"
        } else {
            "step"
        };
        Ok(EnergyDrift {
            name: format!("{}, {unit} {setting:e}", method.title()),
            times: (1..=100).map(|part| 10.0 * f64::from(part)).collect(),
            errors,
            evaluations: solution.report.evaluations,
        })
    };
    cases.into_iter().map(run).collect()
}
