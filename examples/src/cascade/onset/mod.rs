//! The onset in a binary tree of fifteen rods, released almost in phase: which sectors
//! does the energy go to, and who gives it to whom?
//!
//! - [`scene`]: the tree, and its sectors by where they branch,
//! - [`run()`]: one trajectory with the budgets of all sectors,
//! - [`report`]: tables, [`charts`]: charts.

pub mod charts;
pub mod report;
pub mod run;
pub mod scene;

pub use run::Onset;
pub use scene::{Level, Tree};

use branched_pendulum_program::Failure;
use branched_pendulum_program::frame::Job;
use scene::TreeParameters;

/// The quantities that are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Release {
    /// Time followed, s.
    pub duration: f64,
    /// Amplitude of the torque on the root, N m.
    pub torque: f64,
    /// Frequency of the torque, Hz.
    pub frequency: f64,
    /// Every difference at the release from rest, rad.
    pub difference: f64,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
}

impl Default for Release {
    fn default() -> Self {
        Self {
            duration: 20.0,
            torque: 0.2,
            frequency: 0.6,
            difference: 1e-3,
            tolerance: 1e-12,
        }
    }
}

/// Follows the tree, prints the tables and writes samples and charts.
///
/// # Errors
/// [`Failure`].
pub fn run(release: &Release, job: &Job) -> Result<(), Failure> {
    // The modes do not depend on the drive.
    let modes = scene::modes(&Tree::new(TreeParameters {
        torque: 0.0,
        pace: 0.0,
    })?)?;
    let progress = job.progress(1);
    progress.begin("fifteen rods");
    let run = Onset::new(release, |done| progress.within(0, done))?;
    report::write_samples(job, &run)?;
    job.print(&(report::report(release, &modes, &run) + "\n"))?;
    job.chart("onset", &charts::chart(&run))?;
    job.report("steps", run.account.accepted);
    job.report("evaluations", run.account.evaluations);
    Ok(())
}
