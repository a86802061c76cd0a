//! Growth of the antiphase mode against the angle of release, by the linear equations of
//! small differences: windows in which it grows, without friction and with.
//!
//! - [`arguments`]: the command line, [`scene`]: the pendulum in phase,
//! - [`scan`]: growth at every angle, [`windows`](branched_pendulum_frame::windows): where it is large,
//! - [`report`]: words and table, [`charts`]: charts,
//! - [`trees`]: the threshold of trees by rule.

pub mod arguments;
pub mod charts;
pub mod report;
pub mod scan;
pub mod scene;
pub mod trees;

pub use arguments::Arguments;
pub use scan::{Friction, Scan};

use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Computes the growth with every friction, prints the windows and writes table and
/// charts. Ctrl-C leaves the frictions that are done.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    if arguments.trees {
        return trees::run(arguments, job);
    }
    let frictions = Friction::all(arguments);
    let progress = job.progress(frictions.len());
    let mut scans = Vec::new();
    for friction in frictions {
        if job.is_interrupted() {
            break;
        }
        progress.begin(&friction.to_string());
        let done = scans.len();
        let share = |share| progress.within(done, share);
        scans.push(Scan::new(arguments, friction, share)?);
        job.take_interruption();
    }
    if scans.is_empty() {
        return Ok(());
    }
    job.print(&report::report(arguments, &scans))?;
    report::write(job, arguments, &scans)?;
    charts::write(job, arguments, &scans)?;
    let undetermined = scans.iter().map(|scan| scan.undetermined().count());
    job.report("undetermined", undetermined.collect::<Vec<_>>());
    Ok(())
}
