//! Masses, lengths, inertias and friction of a real pendulum from its measured motion.
//!
//! - [`arguments`]: the command line, [`unknowns`]: what is known of the tree's parameters,
//! - [`source`]: angles out of a file, or simulated,
//! - [`study`]: fits with three laws of friction, and what they leave over,
//! - [`small_motions`]: a fit of frequencies alone,
//! - [`report`]: words and tables, [`estimates`]: those of one fit, [`charts`]: charts.

pub mod arguments;
pub mod charts;
pub mod estimates;
pub mod report;
pub mod small_motions;
pub mod source;
pub mod study;
pub mod unknowns;

pub use arguments::Arguments;
pub use source::Measurement;
pub use study::{Outcome, Study};
pub use unknowns::Unknowns;

use branched_pendulum_measure::IdentificationError;

use crate::Failure;
use crate::frame::Job;

/// Reads or simulates the angles, fits them with each law of friction, prints the report and
/// writes table and chart. Frequencies in place of a file are fitted alone. Ctrl-C leaves the laws
/// that are done.
///
/// # Errors
/// [`Failure`]; where no law was found to follow the motion, too, after the report.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let unknowns = Unknowns::new(arguments)?;
    if arguments.measured.file.is_none() && !arguments.frequency.is_empty() {
        return small_motions::run(arguments, &unknowns, job);
    }
    let measurement = Measurement::new(arguments, &unknowns)?;
    let study = Study::new(arguments, &unknowns, &measurement);
    let laws = unknowns.laws(&arguments.laws);
    let progress = job.progress(laws.len());
    let mut outcomes: Vec<Outcome> = Vec::new();
    for law in laws {
        if job.is_interrupted() {
            break;
        }
        progress.begin(law.name());
        let poorer = outcomes.iter().rfind(|other| other.law < law);
        let outcome = progress.ticking(|| study.outcome(law, poorer))?;
        outcomes.push(outcome);
        job.take_interruption();
        progress.next();
    }
    let Some(last) = outcomes.last() else {
        return Ok(());
    };
    // Of the richest law by which something was found.
    let reported = outcomes.iter().rfind(|outcome| outcome.result().is_ok());
    let reported = reported.unwrap_or(last);
    let energies = match &reported.one_motion {
        Ok(fit) => Some(study.energies(reported.law, fit)?),
        Err(_) => None,
    };
    job.print(&report::report(
        arguments,
        &unknowns,
        &measurement,
        &outcomes,
        reported,
        energies.as_ref(),
    ))?;
    report::record(job, &measurement, &outcomes, energies.as_ref());
    report::write(job, &unknowns, &measurement, reported, energies.as_ref())?;
    job.chart_over_time(
        "identified",
        &charts::chart(&measurement, &outcomes, reported, energies.as_ref()),
    )?;
    match reported.result() {
        Ok(_) => Ok(()),
        Err(unfound) => Err(IdentificationError::NotFound(Box::new(unfound.clone())).into()),
    }
}
