//! Error, time and evaluations.

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;
use branched_pendulum_advice::WorkPrecision;

use super::reference::{Problem, Tree};
use crate::scenes::{BranchedDouble, FifteenRods, Rods, ThirtyOneRods};
use crate::solvers::configured;
use branched_pendulum_frame::Progress;

/// Measures a problem with every method, as one part of `progress`; runs that fail
/// are left out.
pub fn measure(problem: &Problem, progress: &Progress) -> WorkPrecision {
    match problem.tree {
        Tree::Paper => measure_on(&AbsoluteAngles(&BranchedDouble::new()), problem, progress),
        Tree::Rods => measure_on(&AbsoluteAngles(&Rods::new()), problem, progress),
        Tree::FifteenRods => measure_on(&AbsoluteAngles(&FifteenRods::new()), problem, progress),
        Tree::ThirtyOneRods => {
            measure_on(&AbsoluteAngles(&ThirtyOneRods::new()), problem, progress)
        }
    }
}

fn measure_on(ode: &impl TaylorOde<f64>, problem: &Problem, progress: &Progress) -> WorkPrecision {
    let start = State::at_rest(0.0, &problem.start);
    let mut done = 0.0;
    let reported = |method: Method, part| {
        progress.show_message(&format!("{}: {}", problem.name, method.title()));
        progress.advance(part - done);
        done = part;
    };
    let (end, expected) = (problem.end, &problem.expected);
    let methods = WorkPrecision::METHODS;
    let measured = WorkPrecision::measure(ode, &start, end, expected, &methods, reported);
    progress.advance(1.0 - done);
    measured
}

/// Largest relative error of the energy in each of a hundred parts of a regular motion of 1,000 s.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyDrift {
    /// Method and setting, as the chart names them.
    pub name: String,
    /// End of each part, s.
    pub times: Vec<f64>,
    /// Error in each part.
    pub errors: Vec<f64>,
    /// Evaluations of the whole run.
    pub evaluations: u64,
}

/// Integrates a regular motion with every method, at one setting each, and records the energy; one
/// part of `progress`.
///
/// # Errors
/// Errors of the methods.
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
