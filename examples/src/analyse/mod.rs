//! From measured angles of a pendulum to its energy and power, with their errors.
//!
//! - [`arguments`]: the command line,
//! - [`subject`]: the pendulums, [`scenes`] and [`parameters`]: their descriptions,
//! - [`source`]: angles out of a file, or of a simulated [`camera`],
//! - [`motion`]: motions that the angles allow, [`estimate`]: what follows from them,
//! - [`spectrogram`]: its lines,
//! - [`report`]: words and tables, [`charts`]: charts.

pub mod arguments;
pub mod camera;
pub mod charts;
pub mod estimate;
pub mod motion;
pub mod parameters;
pub mod report;
pub mod scenes;
pub mod source;
pub mod spectrogram;
pub mod subject;
#[cfg(test)]
mod tests;

pub use arguments::Arguments;
pub use estimate::{Draws, Estimate, Measured};
pub use source::Source;
pub use subject::{Subject, TwoLinks};

use branched_pendulum::Parametric;

use crate::branched_double::Apparatus;
use crate::failure::Failure;
use crate::identify::scene::Chain;
use crate::program::Job;
use arguments::Tree;
use spectrogram::Spectrogram;

/// Reads or simulates the angles, estimates the motion, prints the report and writes tables
/// and charts.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    match arguments.pendulum {
        Tree::Branched => {
            let apparatus = Apparatus::new(arguments.friction)?;
            let source = match &arguments.measured.file {
                Some(file) => Source::open(file, arguments)?,
                None => Source::simulate(arguments)?,
            };
            analyse(arguments, job, &apparatus, &source)
        }
        Tree::Chain => {
            let read = arguments.parameters.as_deref().map(parameters::read);
            let values = read.transpose()?.unwrap_or_else(parameters::fitted);
            if let Err(error) = Chain::<f64>::check_parameters(|index| values[index]) {
                job.print(&format!(
                    "No pendulum is such, but taken as it is: {error}.\n"
                ))?;
            }
            let chain = TwoLinks::new(&values);
            let file = arguments.measured.file.as_deref().unwrap_or("".as_ref());
            analyse(arguments, job, &chain, &Source::open(file, arguments)?)
        }
    }
}

fn analyse<const N: usize>(
    arguments: &Arguments,
    job: &Job,
    subject: &dyn Subject<N>,
    source: &Source<N>,
) -> Result<(), Failure> {
    let draws = Draws {
        count: arguments.draws as usize,
        seed: arguments.seed,
    };
    let record = source.record();
    let measured = Measured { subject, record };
    let progress = job.progress(1 + usize::from(arguments.model));
    let mut estimate = if arguments.polynomials {
        progress.begin("by polynomials");
        measured.by_polynomials(draws)?
    } else {
        progress.begin("by smoothness");
        measured.by_smoothness(draws)?
    };
    if arguments.model {
        progress.begin("by the equations of motion");
        estimate = measured.by_model(&estimate, draws)?;
    }
    let names = subject.names();
    report::write(job, &names, source, &estimate)?;
    job.print(&report::report(arguments, &names, source, &estimate))?;
    job.chart("estimate", &charts::chart(subject, source, &estimate))?;
    if let Some(spectrogram) = Spectrogram::of(&names, source, &estimate)? {
        spectrogram.write(job)?;
    }
    let findings = source.findings.iter().map(ToString::to_string);
    job.report("findings", findings.collect::<Vec<_>>());
    job.report("noise", estimate.noise);
    Ok(())
}
