//! The cost of a given error for each method.
//!
//! The trees are the paper's apparatus and rods. The equations are those that the macro generates,
//! in absolute angles. Errors are differences from reference trajectories, which were computed with
//! arbitrary precision; for the rods, with the same equations and twice the number of digits.
//! `branched-pendulum methods` measures a tree at run time.
//!
//! - [`mod@reference`]: the trajectories,
//! - [`measure`]: error, time and evaluations of one run; energy over 1,000 s,
//! - [`output`]: tables, CSV files and charts.

pub mod measure;
pub mod output;
pub mod reference;

use clap::Parser;

use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Measures what a given error costs with each method: runs the paper's branched
/// double pendulum and seven rods with every method at many tolerances or steps,
/// against reference trajectories, and follows the energy over 1,000 s. For your own
/// tree, use `branched-pendulum methods`.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "work-precision", version, verbatim_doc_comment)]
pub struct Arguments {
    /// runs fifteen and thirty-one rods instead
    #[arg(long)]
    large: bool,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("work-precision-output");
}

/// Measures all problems, and the energy errors over a long time.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let problems = match arguments.large {
        true => reference::large_problems()?,
        false => reference::problems()?,
    };
    let progress = job.progress(problems.len() + usize::from(!arguments.large));
    let problems: Vec<_> = problems
        .iter()
        .map(|problem| (problem.name, measure::measure(problem, &progress)))
        .collect();
    output::write_runs(job, &problems)?;
    job.print(&output::table(&problems))?;
    if arguments.large {
        return Ok(());
    }
    let drifts = measure::energy_drifts(&progress)
        .map_err(|error| Failure::integration(0.3_f64.to_degrees(), error))?;
    output::write_drifts(job, &drifts)?;
    job.print(&output::drift_table(&drifts))
}
