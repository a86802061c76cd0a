//! Computation of a pendulum's energy and power, with their errors, from its measured angles.
//!
//! - [`arguments`]: the command line,
//! - [`subject`]: the tree, [`constants`]: the values of its parameters, [`frictions`]: those that
//!   may be lacking,
//! - [`source`]: angles out of a file, or of a simulated [`camera`],
//! - [`leaps`]: rows where the record leaves the equations of motion for a moment,
//! - [`estimate`]: what follows from motions that the angles allow,
//! - [`verdict`]: whether the energy budget closes, [`causes`]: readings of the table by which it
//!   does, [`least`] and [`wrong_pictures`]: what they take from the data,
//! - [`spectrogram`]: lines of the motion,
//! - [`report`]: words and tables, [`charts`]: charts.

pub mod arguments;
pub mod camera;
pub mod causes;
pub mod charts;
pub mod constants;
pub mod estimate;
pub mod frictions;
pub mod leaps;
pub mod least;
pub mod report;
pub mod source;
pub mod spectrogram;
pub mod subject;
#[cfg(test)]
mod tests;
pub mod verdict;
pub mod wrong_pictures;

pub use arguments::Arguments;
pub use estimate::{Draws, Estimate, Measured};
pub use source::Source;
pub use subject::MeasuredTree;

use branched_pendulum_data::Table;

use crate::Failure;
use crate::frame::{Job, Progress};
use crate::measured_file::MeasuredLinks;
use causes::{CauseSearch, Unclosed, with_remedy};
use leaps::Leaps;
use spectrogram::Spectrogram;
use verdict::Verdict;

/// Reads or simulates the angles, estimates the motion, prints verdict and report and writes
/// tables and charts.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let file = arguments.measured.file.as_deref();
    let table = file.map(|file| arguments.measured.table(file));
    let table = table.transpose()?;
    let known = arguments.tree.described()?;
    known.note(job)?;
    file.map_or(Ok(()), |file| job.input_file(file))?;
    let (described, impossible) = constants::assumed(&known)?;
    if let Some(error) = impossible {
        job.print(&format!(
            "These constants are not physical ({error}); continuing with them.\n"
        ))?;
    }
    let subject = MeasuredTree::new(&described, arguments.sector.as_deref())?;
    let hung = MeasuredLinks::new(&described, &known.offsets, &arguments.measured)?;
    let source = match &table {
        Some(table) => Source::read(table, arguments, &hung)
            .map_err(|error| with_remedy(error, table, arguments, &hung))?,
        None => Source::simulate(
            arguments,
            &constants::real(&known, &arguments.real.concat())?,
        )?,
    };
    let offsets = described.tree.names().iter().cloned();
    let offsets = offsets.zip(source.offsets.iter().copied());
    described.record_with(job, offsets.collect())?;
    analyse(
        arguments,
        job,
        &subject,
        table.as_ref().map(|table| (table, &hung)),
        source,
    )
}

fn analyse(
    arguments: &Arguments,
    job: &Job,
    subject: &MeasuredTree,
    table: Option<(&Table, &MeasuredLinks)>,
    mut source: Source,
) -> Result<(), Failure> {
    let progress = job.progress(1 + usize::from(arguments.model));
    let (estimate, verdict, search) = judged(arguments, subject, table, &source, &progress)?;
    // Angles that are read in a wrong way leave the equations of motion at sound rows.
    let is_misread = search.as_ref().is_some_and(CauseSearch::is_misread);
    if table.is_some() && !is_misread {
        let leaps = Leaps::of(subject, &source)?;
        source.findings.splice(0..0, leaps.finding());
        let times = leaps.times.iter().map(|ends| ends.to_vec());
        job.report("leaps", times.collect::<Vec<_>>());
    }
    let source = &source;
    let names = subject.names();
    report::write(job, names, source, &estimate)?;
    job.print(&verdict.words(arguments, names, search.as_ref()))?;
    job.print(&report::report(arguments, names, source, &estimate))?;
    job.chart_over_time("estimate", &charts::chart(subject, source, &estimate))?;
    if let Some(spectrogram) = Spectrogram::of(names, source, &estimate)? {
        spectrogram.write(job)?;
    }
    let findings = source.findings.iter().map(ToString::to_string);
    job.report("verdict", verdict.values(search.as_ref()));
    job.report("findings", findings.collect::<Vec<_>>());
    job.report("noise", estimate.noise);
    Ok(())
}

/// Estimates the motion and judges its energy budget; if the budget does not close, searches for
/// causes in the table.
fn judged(
    arguments: &Arguments,
    subject: &MeasuredTree,
    table: Option<(&Table, &MeasuredLinks)>,
    source: &Source,
    progress: &Progress,
) -> Result<(Estimate, Verdict, Option<CauseSearch>), Failure> {
    let draws = Draws {
        count: arguments.draws as usize,
        seed: arguments.seed,
    };
    let record = source.record();
    let measured = Measured { subject, record };
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
    let verdict = Verdict::of(&source.times, &estimate, draws.count);
    let unclosed = table.filter(|_| !verdict.closes());
    let unclosed = unclosed.map(|(table, hung)| Unclosed {
        arguments,
        subject,
        table,
        hung,
        source,
        verdict: verdict.clone(),
    });
    let search = unclosed.map(|unclosed| unclosed.search(progress));
    Ok((estimate, verdict, search.transpose()?))
}
