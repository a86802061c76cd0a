//! A binary tree of four generations on a driven root: which sectors does the
//! energy go to, and who gives it to whom?
//!
//! - [`arguments`]: the command line,
//! - [`scene`]: the tree, and its sectors by where they branch,
//! - [`run()`]: one trajectory with the budgets of all sectors,
//! - [`report`]: tables, [`charts`]: charts.

pub mod arguments;
pub mod charts;
pub mod report;
pub mod run;
pub mod scene;

pub use arguments::Arguments;
pub use run::{Cascade, Work};
pub use scene::{Level, Tree};

use crate::failure::Failure;
use crate::program::Job;
use scene::TreeParameters;

/// Follows the tree, prints the tables and writes samples and charts.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    // The modes do not depend on the drive.
    let modes = scene::modes(&Tree::new(TreeParameters {
        torque: 0.0,
        pace: 0.0,
    })?)?;
    let progress = job.progress(1);
    progress.begin("fifteen rods");
    let run = Cascade::new(arguments, |done| progress.within(0, done))?;
    report::write_samples(job, &run)?;
    job.print(&(report::report(arguments, &modes, &run) + "\n"))?;
    job.chart("energy-cascade", &charts::chart(&run))?;
    job.report("steps", run.work.steps);
    job.report("evaluations", run.work.evaluations);
    Ok(())
}
