//! The motion of a tree, integrated and sampled.

use branched_pendulum::integrate::{AnyIntegrator, Report};
use branched_pendulum::prelude::*;

use crate::Failure;
use crate::frame::command_line::number;
use crate::subject::Subject;

/// Options that say how motions are integrated.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct MethodArguments {
    /// method: dop853, dopri5, verner98, taylor, rk4, gauss2, gauss4, gauss6, gauss8 or animation
    #[arg(long, value_name = "METHOD", default_value = "dop853")]
    pub method: Method,
    /// relative error of one step, 1e-16 to 1e-2, 1e-10 unless it is given; of methods with steps
    /// of one length the step in s, 1e-3 unless it is given
    #[arg(verbatim_doc_comment, long, value_name = "TOL", value_parser = number(1e-16..=1e-2, ""))]
    pub tolerance: Option<f64>,
}

impl MethodArguments {
    /// Names of the options.
    pub const OPTIONS: [&str; 2] = ["method", "tolerance"];

    /// Returns the method with its tolerance or step.
    pub fn integrator(&self) -> AnyIntegrator<f64> {
        let usual = if self.method.is_adaptive() {
            1e-10
        } else {
            1e-3
        };
        self.method.with(self.tolerance.unwrap_or(usual))
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

/// Integrates a tree and samples it at times that begin with the start's.
///
/// # Errors
/// [`Failure::Motion`].
pub fn sample(
    subject: &Subject,
    arguments: &MethodArguments,
    start: &State<f64>,
    times: Vec<f64>,
) -> Result<SampledMotion, Failure> {
    let method = arguments.integrator();
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
