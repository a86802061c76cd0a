//! From measured angles of the paper's pendulum to H_d and W, with their errors.
//!
//! - [`arguments`]: the command line,
//! - [`source`]: angles out of a file, or of a simulated [`camera`],
//! - [`estimate`]: the motion, and what follows from it,
//! - [`report`]: words and tables, [`charts`]: charts.

pub mod arguments;
pub mod camera;
pub mod charts;
pub mod estimate;
pub mod report;
pub mod source;

pub use arguments::Arguments;
pub use estimate::{Draws, Estimate, Measured};
pub use source::Source;

use crate::branched_double::Apparatus;
use crate::failure::Failure;
use crate::program::Job;

/// Reads or simulates the angles, estimates the motion, prints the report and writes table
/// and chart.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let apparatus = Apparatus::new(arguments.friction)?;
    let source = Source::new(arguments, &apparatus)?;
    let draws = Draws {
        count: arguments.draws as usize,
        seed: arguments.seed,
    };
    let measured = Measured {
        apparatus: &apparatus,
        times: &source.times,
        angles: &source.angles,
    };
    let progress = job.progress(1 + usize::from(arguments.model));
    progress.begin("by smoothness");
    let mut estimate = measured.by_smoothness(draws)?;
    if arguments.model {
        progress.begin("by the equations of motion");
        estimate = measured.by_model(&estimate, draws)?;
    }
    report::write(job, &source, &estimate)?;
    job.print(&report::report(arguments, &source, &estimate))?;
    job.chart("estimate", &charts::chart(&source, &estimate))?;
    let findings = source.findings.iter().map(ToString::to_string);
    job.report("findings", findings.collect::<Vec<_>>());
    job.report("noise", estimate.noise);
    Ok(())
}
