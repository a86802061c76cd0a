//! Main program: runs all angles and writes their tables, files and charts.

use serde_json::json;

use super::apparatus::Friction;
use super::scenes::BranchedDouble;
use super::table;
use super::{
    Apparatus, Arguments, Findings, Frequencies, Run, charts, film, growth, lines, samples,
};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Text of the error if a run without friction is requested that was not computed; it names the
/// nearest run.
const NEAREST_THE_PAPER: &str = "\
Without friction the antiphase mode grows from more angles than in the paper's experiment.
Its figures are met best by `--friction-children 3.5e-5 --disturbance 0.02`.

";

/// Runs the experiment from every angle. The samples of an angle are written as soon as its run
/// ends.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let frequencies = Frequencies::of(&BranchedDouble::new())?;
    let apparatus = Apparatus::new(arguments.friction)?;
    let progress = job.progress(arguments.angles_deg.len());
    let mut runs = Vec::new();
    for (index, &angle) in arguments.angles_deg.iter().enumerate() {
        progress.begin(&format!("{angle:?}°"));
        let run = Run::new(angle, arguments, |part| progress.within(index, part))?;
        samples::write(job, &run)?;
        runs.push(run);
    }
    let findings: Vec<Findings> = runs.iter().map(Findings::new).collect();
    let report = table::report(arguments, &apparatus, frequencies, &runs, &findings);
    let bands = growth::report(&runs, &findings);
    job.print(&format!("{report}\n{bands}\n"))?;
    if let Some(gentlest) = runs.first() {
        let lines = lines::of(gentlest, arguments.rate)?;
        job.print(&format!("{}\n", lines::report(gentlest.angle_deg, &lines)))?;
    }
    if arguments.friction == Friction::default() {
        job.print(NEAREST_THE_PAPER)?;
    }
    charts::write(job, arguments, frequencies, &runs)?;
    growth::write(job, arguments, &runs, &findings)?;
    if arguments.animate {
        film::write(job, arguments, &runs)?;
    }
    let work = runs.iter().map(|run| {
        json!({
            "angle_deg": run.angle_deg,
            "steps": run.work.steps,
            "rejected": run.work.rejected,
            "evaluations": run.work.evaluations,
        })
    });
    job.report("runs", work.collect::<Vec<_>>());
    Ok(())
}
