//! Onset of differences in a tree that is released almost in phase: which sectors receive energy,
//! and from which other sectors?
//!
//! - [`run()`]: one trajectory with the budgets of all sectors,
//! - [`report`]: tables, [`charts`]: charts.

pub mod charts;
pub mod report;
pub mod run;

pub use run::Onset;

use std::f64::consts::TAU;

use branched_pendulum::analysis::SectorModes;
use branched_pendulum::prelude::State;
use branched_pendulum::sectors::Sectors;
use branched_pendulum_trees::TreeDescription;

use crate::Failure;
use crate::frame::Job;
use crate::subject::Subject;

/// Largest number of sectors that the tables show.
const MOST_SECTORS: usize = 64;

/// The quantities that are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Release {
    /// State from which all differences are measured.
    pub start: State<f64>,
    /// Time followed, s.
    pub duration: f64,
    /// Amplitude of the torque on the root, N m.
    pub torque: f64,
    /// Frequency of the torque, Hz.
    pub frequency: f64,
    /// Largest difference at the release, rad.
    pub difference: f64,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
}

impl Release {
    /// Returns the release from a given state, with default values.
    pub fn new(start: State<f64>) -> Self {
        Self {
            start,
            duration: 20.0,
            torque: 0.2,
            frequency: 0.6,
            difference: 1e-3,
            tolerance: 1e-12,
        }
    }

    /// Returns the tree with the torque as a drive; if the tree has a drive already, that drive is
    /// kept.
    ///
    /// # Errors
    /// [`Failure::Tree`].
    pub fn driven(&self, subject: &Subject) -> Result<Subject, Failure> {
        let own = subject.tree.description();
        if subject.tree.drive(0.0).is_some() {
            return Ok(subject.clone());
        }
        let refused = |source| Failure::tree(&subject.name, source);
        let text = format!(
            "drive(torque = {:e} * cos({:e} * t)),\n{}",
            self.torque,
            TAU * self.frequency,
            subject.text
        );
        let description = TreeDescription::parse(&text).map_err(|error| refused(error.into()))?;
        let values: Vec<(&str, f64)> = own
            .parameters()
            .filter_map(|name| Some((name, subject.tree.value(name)?)))
            .collect();
        Ok(Subject {
            name: subject.name.clone(),
            tree: description.tree(&values).map_err(refused)?,
            inputs: subject.inputs.clone(),
            text,
        })
    }
}

/// Integrates the motion of the tree, prints the tables and writes samples and charts.
///
/// # Errors
/// [`Failure`]; [`Failure::Tree`] if the tree has no copies, [`Failure::Lacking`] if it has too
/// many sectors or copies that differ.
pub fn run(release: &Release, subject: &Subject, job: &Job) -> Result<(), Failure> {
    let (tree, name) = (&subject.tree, &subject.name);
    let symmetric = tree
        .symmetric()
        .map_err(|source| Failure::tree(name, source))?;
    let sectors = tree.sectors().len();
    let what = match () {
        () if sectors > MOST_SECTORS => Some(format!(
            "`{name}` has {sectors} sectors, but the onset is computed for at most \
             {MOST_SECTORS}: leave out `--onset` to compute energies by scale"
        )),
        () if symmetric.has_unequal_copies() => Some(format!(
            "copies of `{name}` differ: the onset is computed only for equal copies"
        )),
        () => None,
    };
    if let Some(what) = what {
        return Err(Failure::Lacking { what });
    }
    let theta = release.start.positions();
    let (mass, stiffness) = (tree.mass_matrix(theta), tree.stiffness_matrix(theta));
    let modes = SectorModes::new(tree.sectors(), &mass, &stiffness)?;
    let driven = release.driven(subject)?;
    let progress = job.progress(1);
    progress.begin("onset");
    let run = Onset::new(release, &driven, |done| progress.within(0, done))?;
    report::write_samples(job, &driven, &run)?;
    job.print(&(report::report(release, &driven, &modes, &run) + "\n"))?;
    job.chart_over_time("onset", &charts::chart(&driven, &run))?;
    job.report("steps", run.account.accepted);
    job.report("evaluations", run.account.evaluations);
    Ok(())
}
