//! Identification of masses, lengths, inertias and friction of a real pendulum from its measured
//! motion.
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

use std::cell::Cell;
use std::ops::ControlFlow;

use branched_pendulum_measure::IdentificationError;
use branched_pendulum_measure::identification::{Fit, SearchProgress};

use crate::Failure;
use crate::frame::Job;
use arguments::Law;

/// Reads or simulates the angles, fits them with each law of friction, prints the report and writes
/// table and chart. If only frequencies are given instead of a file, these are fitted. After Ctrl-C
/// the best result so far is reported.
///
/// # Errors
/// [`Failure`]; also, after the report, if no law can reproduce the motion.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let unknowns = Unknowns::new(arguments)?;
    unknowns.described.note(job)?;
    let file = arguments.measured.file.as_deref();
    file.map_or(Ok(()), |file| job.input_file(file))?;
    if arguments.measured.file.is_none() && !arguments.frequency.is_empty() {
        return small_motions::run(arguments, &unknowns, job);
    }
    let measurement = Measurement::new(arguments, &unknowns)?;
    let study = Study::new(arguments, &unknowns, &measurement);
    let laws = unknowns.laws(&arguments.laws);
    let progress = job.progress(laws.len());
    let mut outcomes: Vec<Outcome> = Vec::new();
    // After Ctrl-C the best found so far is a result.
    job.take_interruption();
    for law in laws {
        if job.is_interrupted() {
            break;
        }
        progress.begin(law.name());
        let poorer = outcomes.iter().rfind(|other| other.law < law);
        let shown = Cell::new([f64::NAN; 3]);
        let observer = |own: &SearchProgress| {
            let percent = (100.0 * own.share).floor();
            let now = [percent, own.segment, own.rms];
            if shown.replace(now) != now {
                progress.show_message(&words(law, own));
            }
            match job.is_interrupted() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let outcome = progress.ticking(|| study.outcome(law, poorer, &observer))?;
        outcomes.push(outcome);
        progress.next();
    }
    let Some(reported) = reported(&outcomes) else {
        return Ok(());
    };
    let energies = match &reported.found.one_motion {
        Ok(fit) if !job.is_interrupted() => Some(study.energies(reported.law, fit)?),
        _ => None,
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
        Err(_) if job.is_interrupted() => Ok(()),
        Err(unfound) => Err(IdentificationError::NotFound(Box::new(unfound.clone())).into()),
    }
}

/// Returns the outcome that is reported: the one of the richest law with a result or, if there is no
/// result, the one that leaves the smallest residual.
fn reported(outcomes: &[Outcome]) -> Option<&Outcome> {
    let residual = |own: &Outcome| own.result().map_or_else(|own| own.best.rms(), Fit::rms);
    let nearest = || {
        let outcomes = outcomes.iter();
        outcomes.min_by(|one, other| residual(one).total_cmp(&residual(other)))
    };
    let found = outcomes.iter().rfind(|own| own.result().is_ok());
    found.or_else(nearest)
}

/// Describes the progress of a search.
fn words(law: Law, progress: &SearchProgress) -> String {
    let work = format!("{:.0} % of the allowed work", 100.0 * progress.share);
    match progress.rms.is_nan() {
        true => format!("{}: first windows, {work}", law.name()),
        false => format!(
            "{}: windows of {:.3} s, residual {:.3} mrad, {work}",
            law.name(),
            progress.segment,
            1e3 * progress.rms
        ),
    }
}
