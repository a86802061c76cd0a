//! Motion of a tree, integrated and sampled.

use branched_pendulum::integrate::{Horizon, MethodChoice, Report};
use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;

use crate::Failure;
use crate::frame::command_line::number;
use crate::subject::Subject;

/// Command-line options for the integration of motions.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct MethodArguments {
    /// integration method: auto, dop853, dopri5, verner98, taylor, rk4, gauss2, gauss4, gauss6, gauss8
    /// or animation; auto takes the one that is usually the fastest for the tree and the tolerance
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "METHOD",
        default_value = "auto"
    )]
    pub method: MethodChoice,
    /// relative error of one step, 1e-16 to 0.2, by default 1e-10; for methods with constant steps
    /// the step length in s, by default 1e-3
    #[arg(verbatim_doc_comment, long, value_name = "TOL", value_parser = number(1e-16..=0.2, ""))]
    pub tolerance: Option<f64>,
}

impl MethodArguments {
    /// Names of the options.
    pub const OPTIONS: [&str; 2] = ["method", "tolerance"];

    /// Tolerance of one step by default.
    const TOLERANCE: f64 = 1e-10;

    /// Returns the method that integrates the motions of a tree.
    pub fn method(&self, tree: &PendulumTree) -> Method {
        self.method.method(|| {
            let tolerance = self.tolerance.unwrap_or(Self::TOLERANCE);
            Method::for_model(&AbsoluteAngles(tree), tolerance)
        })
    }

    /// Returns the tolerance of a method, or its step length in s.
    pub fn setting(&self, method: Method) -> f64 {
        let usual = if method.is_adaptive() {
            Self::TOLERANCE
        } else {
            1e-3
        };
        self.tolerance.unwrap_or(usual)
    }
}

/// Times, and the state at each of them.
#[derive(Clone, Debug)]
pub struct SampledMotion {
    /// Times, s.
    pub times: Vec<f64>,
    /// States: angles, then angular velocities.
    pub states: Vec<Vec<f64>>,
    /// Account of the integration.
    pub report: Report<f64>,
}

/// Integrates the motion of a tree and samples it at `times`, the first of which is the start time.
///
/// # Errors
/// [`Failure::Motion`].
pub fn sample(
    subject: &Subject,
    arguments: &MethodArguments,
    start: &State<f64>,
    times: Vec<f64>,
) -> Result<SampledMotion, Failure> {
    let method = arguments.method(&subject.tree);
    let method = method.with(arguments.setting(method));
    let system = AbsoluteAngles(&subject.tree);
    let mut states = Vec::with_capacity(times.len());
    let visit = |_: f64, state: &[f64]| states.push(state.to_vec());
    let solution = method
        .sample(&system, start, &times, visit)
        .map_err(|error| Failure::Motion(Box::new(error)))?;
    Ok(SampledMotion {
        times,
        states,
        report: solution.report,
    })
}

/// Integrates a sampled motion again with a tighter tolerance or step, from a start that differs by
/// rounding. Returns, for each of the precisions (rad), the first time at which angles differ by more:
/// of the sampled times and of the ends of steps.
///
/// # Errors
/// [`Failure::Motion`].
pub fn horizon(
    subject: &Subject,
    arguments: &MethodArguments,
    start: &State<f64>,
    samples: &SampledMotion,
    precisions: &[f64],
) -> Result<Horizon<f64>, Failure> {
    let method = arguments.method(&subject.tree);
    let setting = arguments.setting(method);
    let methods = [setting, method.finer(setting)].map(|own| method.with(own));
    let links = subject.tree.links();
    let system = AbsoluteAngles(&subject.tree);
    let times = &samples.times;
    Horizon::find(methods.each_ref(), &system, start, times, links, precisions)
        .map_err(|error| Failure::Motion(Box::new(error)))
}
