//! Masses, lengths, inertias and friction of a real pendulum from its measured motion.
//!
//! - [`arguments`]: the command line, [`scene`]: the two trees,
//! - [`source`]: angles out of a file, or simulated,
//! - [`study`]: fits with three laws of friction, and what they leave over,
//! - [`report`]: words and tables, [`charts`]: charts.

pub mod arguments;
pub mod charts;
pub mod report;
pub mod scene;
pub mod source;
pub mod study;

pub use arguments::Arguments;
pub use source::Measurement;
pub use study::{Outcome, Study};

use arguments::Tree;
use branched_pendulum_measure::IdentificationError;
use scene::{Branched, Chain, Described};

use branched_pendulum_program::Failure;
use branched_pendulum_program::frame::Job;

/// Reads or simulates the angles, fits them with each law of friction, prints the report and
/// writes table and chart. Ctrl-C leaves the laws that are done.
///
/// # Errors
/// [`Failure`]; where no law was found to follow the motion, too, after the report.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    match arguments.tree {
        Tree::Chain => of_tree::<Chain, 2, 4>(arguments, job),
        Tree::Branched => of_tree::<Branched, 3, 6>(arguments, job),
    }
}

/// For a tree of N links and D = 2N.
fn of_tree<M: Described, const N: usize, const D: usize>(
    arguments: &Arguments,
    job: &Job,
) -> Result<(), Failure> {
    let measurement = Measurement::new::<M>(arguments)?;
    let study = Study::<M>::new(arguments, &measurement);
    let progress = job.progress(arguments.laws.len());
    let mut outcomes: Vec<Outcome> = Vec::new();
    for &law in &arguments.laws {
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
        Ok(fit) => Some(study.energies::<N, D>(reported.law, fit)?),
        Err(_) => None,
    };
    job.print(&report::report(
        arguments,
        &measurement,
        &outcomes,
        reported,
        energies.as_ref(),
    ))?;
    report::record(job, &measurement, &outcomes, energies.as_ref());
    report::write::<M>(job, &measurement, reported, energies.as_ref())?;
    job.chart(
        "identified",
        &charts::chart(&measurement, &outcomes, reported, energies.as_ref()),
    )?;
    match reported.result() {
        Ok(_) => Ok(()),
        Err(unfound) => Err(IdentificationError::NotFound(Box::new(unfound.clone())).into()),
    }
}
