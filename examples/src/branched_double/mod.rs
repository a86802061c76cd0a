//! The paper's experiment: a parent link with two equal children, released
//! from rest with the children hanging straight down, so that only the
//! in-phase modes are excited. Does the antiphase mode grow, and where does
//! its energy come from?
//!
//! Y. Toda and T. Ooshida, "Experimental detection of energy transfer into the
//! anti-phase mode in a branched double pendulum", called *the paper* below.
//!
//! - [`apparatus`]: the pendulum, and what is measured on it at one instant,
//! - [`release`]: one motion, from the release to the last sample,
//! - [`findings`]: growth, first peak, errors of the forms of W,
//! - [`report`]: the findings as text; [`charts`]: the charts of the paper, and a film,
//! - [`spectrum`]: spectrum of θ_m and its lines; [`scan`]: growth against the angle of release.

pub mod apparatus;
pub mod charts;
pub mod findings;
pub mod release;
pub mod report;
pub mod scan;
pub mod spectrum;

use branched_pendulum_frame::command_line::{number, numbers, plain};
use branched_pendulum_frame::{Charts, Failure, Job};
use clap::Parser;

pub use self::apparatus::{BranchedDouble, BranchedDoubleParameters};
pub use self::findings::{Findings, Frequencies};
pub use self::release::Run;

/// Number of samples in each second, Hz.
pub const RATE: f64 = 100.0;

/// The paper's branched double pendulum: a parent link with two equal children,
/// released from rest with the children hanging straight down. Does the antiphase
/// mode θ_d = (θ_2 − θ_3)/2 grow, and which energy transfer W feeds it?
///
/// Prints the eigenfrequencies and one row for each initial angle, and writes one
/// CSV file for each angle, the charts as SVG, PNG and PDF, and run.json.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-double", version, verbatim_doc_comment)]
pub struct Arguments {
    /// initial angles θ_1(0) of the parent link, degrees from -180 to 180;
    /// FROM:TO:STEP for a range, as in 40:48:0.1; by default the paper's
    #[arg(
        verbatim_doc_comment,
        long = "angles",
        id = "angles",
        value_name = "DEG[,DEG]...",
        default_value = "39.5,45,46.4,47.6,47.8,48.6",
        value_parser = numbers(-180.0..=180.0, "degrees"),
        allow_hyphen_values = true
    )]
    // By its full path, clap takes it for one value.
    pub angles_deg: ::std::vec::Vec<f64>,
    /// θ_d(0), rad from -1.5 to 1.5: child 2 starts at +RAD, child 3 at −RAD;
    /// 0.01 is about what remains if one waits, by eye, until the links rest.
    /// The growth factor does not depend on θ_d(0) as long as θ_d is small
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "RAD",
        default_value = "0.01",
        value_parser = number(-1.5..=1.5, "rad"),
        allow_hyphen_values = true
    )]
    pub disturbance: f64,
    /// time observed after the release, s from 1 to 10000; 32 is the span of
    /// the paper's spectrum
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "S",
        default_value = "32",
        value_parser = number(1.0..=1e4, "s")
    )]
    pub duration: f64,
    /// viscous friction in the parent's pivot, N m s from 0 to 1
    #[arg(
        long,
        value_name = "C",
        default_value = "0",
        value_parser = number(0.0..=1.0, "N m s"),
        allow_hyphen_values = true
    )]
    pub friction_root: f64,
    /// viscous friction in each child's pivot, N m s from 0 to 1; 3.5e-5
    /// brings onset and peak near the paper's
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "C",
        default_value = "0",
        value_parser = number(0.0..=1.0, "N m s"),
        allow_hyphen_values = true
    )]
    pub friction_children: f64,
    /// writes a film of all releases as well, as SVG and as animated PNG
    #[arg(long)]
    pub animate: bool,
}

impl Default for Arguments {
    fn default() -> Self {
        Self::parse_from(["branched-double"])
    }
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("branched-double-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        Some(self.duration)
    }
}

impl Arguments {
    /// Creates the pendulum with the requested friction.
    ///
    /// # Errors
    /// [`Failure::Parameter`] for a coefficient that is negative or not finite.
    pub fn model(&self) -> Result<BranchedDouble, Failure> {
        Ok(BranchedDouble::new(BranchedDoubleParameters {
            friction_root: self.friction_root,
            friction_children: self.friction_children,
        })?)
    }

    /// Returns the times of the samples, s.
    pub fn times(&self) -> Vec<f64> {
        // A rounding error must not cost the last sample.
        let intervals = (self.duration * RATE * (1.0 + f64::EPSILON)) as usize;
        (0..=intervals).map(|index| index as f64 / RATE).collect()
    }

    /// Returns true if no joint has friction.
    pub fn is_frictionless(&self) -> bool {
        self.friction_root == 0.0 && self.friction_children == 0.0
    }

    /// Returns the conditions common to all runs, for a title.
    pub fn conditions(&self) -> String {
        let friction = match self.is_frictionless() {
            true => "no friction".to_owned(),
            false => format!(
                "friction {} (root), {} (children) N·m·s",
                plain(self.friction_root),
                plain(self.friction_children)
            ),
        };
        format!("θ_d(0) = {} rad, {friction}", plain(self.disturbance))
    }
}

/// Runs the experiment from every angle. The samples of an angle are written as soon as its run
/// ends.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let model = arguments.model()?;
    let progress = job.progress(arguments.angles_deg.len());
    let mut runs = Vec::new();
    for &angle in &arguments.angles_deg {
        progress.begin(&format!("{angle:?}°"));
        let run = Run::new(&model, angle, arguments)?;
        run.write(job)?;
        runs.push(run);
        progress.next();
    }
    let frequencies = Frequencies::of(&model)?;
    let scan = scan::points(&runs);
    job.print(&report::text(arguments, frequencies, &runs, &scan)?)?;
    charts::write(job, arguments, frequencies, &runs)?;
    scan::write(job, arguments, &scan)?;
    if arguments.animate {
        charts::write_film(job, &model, &runs)?;
    }
    Ok(())
}
