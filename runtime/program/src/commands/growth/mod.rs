//! Growth of small differences between copies, as a function of the angle of release.

mod report;
mod varied;

use branched_pendulum::analysis::growth::{Checked, Grown};
use branched_pendulum::analysis::normal_form::{NormalFormOptions, Tongues};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_trees::PendulumTree;
use clap::Parser;

use self::varied::Varied;
use super::differences::{PairArguments, differences_of, start_apart};
use crate::Failure;
use crate::frame::command_line::{number, numbers};
use crate::frame::{Charts, Job};
use crate::release::ReleaseArguments;
use crate::subject::TreeArguments;

/// From which release angle on do differences between copies grow? The growth factor G(T) is the
/// largest difference within the time T divided by the difference at the start. It is computed for
/// an infinitesimal difference, by linear equations along the in-phase motion, which starts at
/// rest. Prints the windows of release angles in which G is large, and writes table and chart.
///
/// The size of a difference is √(Σ δ²) over all links that differ.
///
/// Every value is computed at two tolerances; if they differ by more than 1 %, it is marked as not
/// determined. Nothing is said about angles between those of the scan.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum growth", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    pair: PairArguments,
    /// link whose initial angle is scanned; by default the root
    #[arg(long, value_name = "LINK")]
    link: Option<String>,
    /// angles of that link at the start, degrees from 0 to 180; FROM:TO:STEP for a range
    #[arg(
        verbatim_doc_comment,
        long = "angles",
        id = "angles",
        value_name = "DEG[,DEG]...",
        default_value = "5:90:1",
        value_parser = numbers(0.0..=180.0, "degrees")
    )]
    // By its full path, clap takes each for one value.
    angles_deg: ::std::vec::Vec<f64>,
    /// times T after the release, s from 0.1 to 1000
    #[arg(
        long,
        value_name = "S[,S]...",
        default_value = "4,10,30",
        value_parser = numbers(0.1..=1000.0, "s")
    )]
    horizons: ::std::vec::Vec<f64>,
    /// growth factors for which windows of angles are listed, 1.1 to 1e12
    #[arg(
        long,
        value_name = "G[,G]...",
        default_value = "10,100",
        value_parser = numbers(1.1..=1e12, "")
    )]
    levels: ::std::vec::Vec<f64>,
    /// repeats the scan for each of these values of a parameter, such as a coefficient of friction
    #[arg(long, value_name = "NAME=VALUE[,VALUE]...", value_parser = Varied::values)]
    vary: Option<Varied>,
    /// repeats the scan with several values of a parameter that is a viscous friction coefficient:
    /// zero, and the values for which a small difference at rest has these quality factors
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "NAME=Q[,Q]...",
        value_parser = Varied::quality_factors,
        conflicts_with = "vary"
    )]
    quality: Option<Varied>,
    /// also predicts the windows of growth by the normal form of degree 8, and draws their edges
    #[arg(long)]
    theory: bool,
    /// angles at which all scans are compared, and which the chart marks, in degrees from 0 to 180
    #[arg(long, value_name = "DEG[,DEG]...", value_parser = numbers(0.0..=180.0, "degrees"))]
    mark: Option<::std::vec::Vec<f64>>,
    /// relative error of one integration step, 1e-12 to 1e-3; everything is repeated with a
    /// hundredth of it, and the values of the repetition are reported
    #[arg(verbatim_doc_comment, long, value_name = "TOL", default_value = "1e-9", value_parser = number(1e-12..=1e-3, ""))]
    tolerance: f64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("growth-output");
    const CHARTS: Charts = Charts::Any;
}

/// Number of angles that are computed at a time.
const BLOCK: usize = 128;

/// One scan over the angles.
struct Scan {
    label: String,
    /// Frequency of a small difference about equilibrium, in Hz.
    frequency_hz: f64,
    grown: Vec<Grown>,
    /// Growth at the marked angles.
    marked: Vec<Grown>,
    /// Rate at which friction damps a small difference about equilibrium, in 1/s.
    decay: f64,
    /// Predicted windows of growth, if `--theory` is given.
    predicted: Option<Tongues>,
}

impl Scan {
    /// Computes the growth at every angle, and reports the completed fraction to `progress`.
    fn new(
        arguments: &Arguments,
        label: String,
        tree: &PendulumTree,
        copies: &Copies,
        start: impl Fn(f64) -> State<f64>,
        progress: impl Fn(f64),
    ) -> Result<Self, Failure> {
        let (horizons, tolerance) = (arguments.horizons.clone(), arguments.tolerance);
        let differences = differences_of(tree, copies, horizons, tolerance)?;
        let marks = arguments.mark.iter().flatten();
        let angles = arguments.angles_deg.iter().chain(marks);
        let starts: Vec<State<f64>> = angles.map(|degrees| start(*degrees)).collect();
        let mut grown = Vec::new();
        for block in starts.chunks(BLOCK) {
            let block = differences.in_lanes(&Ensemble::new(), block);
            for one in block.map_err(|_| start_apart())? {
                grown.push(one?);
            }
            progress(grown.len() as f64 / starts.len() as f64);
        }
        let marked = grown.split_off(arguments.angles_deg.len());
        let decay = differences.decay();
        let predicted = match arguments.theory {
            false => None,
            true => {
                let form = tree.normal_form(copies, NormalFormOptions::default());
                let form = form.map_err(|source| Failure::tree(&label, source))?;
                let predict = |degrees: f64| form.predict(&start(degrees));
                Some(Tongues::along(&arguments.angles_deg, decay, predict))
            }
        };
        Ok(Self {
            label,
            frequency_hz: differences.growth().frequency_hz,
            grown,
            marked,
            decay,
            predicted,
        })
    }
}

/// Computes the scans and writes them; after Ctrl-C, the completed scans are written.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let copies = arguments.pair.copies(&subject)?;
    let start = arguments.release.state(&subject)?;
    let scanned = match &arguments.link {
        Some(name) => subject.links_named(name)?,
        None => vec![0],
    };
    let trees = match arguments.vary.as_ref().or(arguments.quality.as_ref()) {
        None => vec![(subject.name.clone(), subject.tree.clone())],
        Some(varied) => varied.trees(&subject, &copies)?,
    };
    let progress = job.progress(trees.len());
    let mut scans = Vec::new();
    for (label, tree) in trees {
        if job.is_interrupted() {
            break;
        }
        progress.begin(&label);
        let done = scans.len();
        let share = |share| progress.within(done, share);
        let start = |degrees: f64| {
            let mut start = start.clone();
            for link in &scanned {
                start.values[*link] = degrees.to_radians();
            }
            start
        };
        scans.push(Scan::new(arguments, label, &tree, &copies, start, share)?);
        job.take_interruption();
    }
    if scans.is_empty() {
        return Ok(());
    }
    let report = report::GrowthReport {
        arguments,
        name: &subject.name,
        link: &subject.tree.names()[scanned[0]],
        scans: &scans,
    };
    job.print(&report.text())?;
    report.write(job)?;
    let open = |scan: &Scan| {
        let is_open = |grown: &&Grown| !grown.factors.iter().all(Checked::is_determined);
        scan.grown.iter().filter(is_open).count()
    };
    job.report("undetermined", scans.iter().map(open).collect::<Vec<_>>());
    if arguments.angles_deg.len() > 1 {
        job.chart("growth", &report.chart())?;
    }
    Ok(())
}
