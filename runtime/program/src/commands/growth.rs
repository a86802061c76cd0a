//! Growth of small differences between copies, against the angle of release.

use std::fmt::Write;

use branched_pendulum::analysis::growth::{BetweenCopies, Checked, Grown, Growth};
use branched_pendulum::analysis::variational::{Copies, linearised};
use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Dash, Panel, Series, verbatim};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::PendulumTree;
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::frame::command_line::{number, numbers, parts};
use crate::frame::windows::{windows, words};
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// From which release on do differences between copies grow? The growth factor G(T) is the
/// largest difference within T over that at the start, for one so small that it stays
/// small: by its linear equations beside the motion in phase, from rest. Prints the windows
/// of release angles in which G is large, and writes table and chart.
///
/// Every value is computed at two tolerances; where they differ by more than 1 % it counts
/// as not determined. Nothing is said about angles between those of the scan.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum growth", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    pair: PairArguments,
    /// link whose angle at the start is scanned; the root, unless it is named
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
    /// growth factors whose windows are listed, 1.1 to 1e12
    #[arg(
        long,
        value_name = "G[,G]...",
        default_value = "10,100",
        value_parser = numbers(1.1..=1e12, "")
    )]
    levels: ::std::vec::Vec<f64>,
    /// repeats the scan with each of these values of a parameter, such as one of friction
    #[arg(long, value_name = "NAME=VALUE[,VALUE]...", value_parser = Varied::read)]
    vary: Option<Varied>,
    /// relative error of one integration step, 1e-12 to 1e-3; all is repeated with a
    /// hundredth of it, whose values are told
    #[arg(verbatim_doc_comment, long, value_name = "TOL", default_value = "1e-9", value_parser = number(1e-12..=1e-3, ""))]
    tolerance: f64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("growth-output");
    const CHARTS: bool = true;
}

impl Arguments {
    /// Returns the trees that are scanned, with their labels.
    fn trees(&self, subject: &Subject) -> Result<Vec<(String, PendulumTree)>, Failure> {
        let Some(Varied { name, values }) = &self.vary else {
            return Ok(vec![(subject.name.clone(), subject.tree.clone())]);
        };
        let varied = values.iter().map(|value| {
            let label = format!("{name} = {value}");
            Ok((label, subject.with(name, *value)?))
        });
        varied.collect()
    }
}

/// A parameter with the values that it takes one after the other.
#[derive(Clone, Debug, PartialEq)]
struct Varied {
    name: String,
    values: Vec<f64>,
}

impl Varied {
    fn read(text: &str) -> Result<Self, String> {
        let (name, values) = text
            .split_once('=')
            .ok_or_else(|| format!("`{text}` is no `NAME=VALUE,VALUE`"))?;
        let value = |part: &str| {
            let value = part.parse::<f64>().ok().filter(|value| value.is_finite());
            value.ok_or_else(|| format!("`{part}` is not a number"))
        };
        Ok(Self {
            name: name.trim().to_owned(),
            values: parts(values).map(value).collect::<Result<_, _>>()?,
        })
    }
}

/// Options that name the copies between which a difference grows.
#[derive(Clone, Debug, clap::Args, PartialEq)]
pub struct PairArguments {
    /// the copies that differ, by their names; those nearest to the root, unless they are
    /// named. Whatever hangs from them differs with them
    #[arg(verbatim_doc_comment, long, value_name = "LINK,LINK[,..]")]
    pair: Option<String>,
}

impl PairArguments {
    /// Returns true where copies are named.
    pub(super) fn is_given(&self) -> bool {
        self.pair.is_some()
    }

    /// Returns the copies.
    ///
    /// # Errors
    /// [`Failure::Lacking`] for a tree without copies and for links that are none.
    pub fn copies(&self, subject: &Subject) -> Result<Copies, Failure> {
        let lacking = |what: String| Failure::Lacking { what };
        let links: Vec<usize> = match &self.pair {
            None => subject.first_copies().ok_or_else(|| {
                lacking(format!(
                    "{} has no copies between which differences could grow: write equal subtrees \
                     once, with `* 2` or `generations(...)`",
                    subject.name
                ))
            })?,
            Some(names) => subject.all_links_named(names)?,
        };
        Copies::of_links(&subject.parents(), &[&links])
            .filter(|_| links.len() > 1)
            .ok_or_else(|| {
                let names = links
                    .iter()
                    .map(|link| subject.tree.names()[*link].as_str());
                let names: Vec<&str> = names.collect();
                lacking(format!(
                    "`--pair`: {} are no copies of each other",
                    names.join(", ")
                ))
            })
    }
}

/// Growth of a difference between copies beside the motions in phase of one tree.
pub(super) struct Differences {
    tree: PendulumTree,
    copies: Copies,
    growth: Growth,
}

impl Differences {
    /// Returns the differences between `copies` of a tree.
    ///
    /// # Errors
    /// [`Failure::Lacking`] where a small difference does not oscillate about the tree at rest
    /// with all angles zero.
    pub(super) fn new(
        tree: &PendulumTree,
        copies: &Copies,
        horizons: Vec<f64>,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let system = BetweenCopies::new(linearised(AbsoluteAngles(tree)), copies.clone());
        let frequency_hz = system.frequency_at_rest().ok_or_else(|| Failure::Lacking {
            what: "a small difference of the copies does not oscillate about the tree at rest \
                       with all angles zero: there is no frequency to look at its growth by"
                .to_owned(),
        })?;
        let growth = Growth {
            frequency_hz,
            horizons,
            tolerance,
        };
        Ok(Self {
            tree: tree.clone(),
            copies: copies.clone(),
            growth,
        })
    }

    /// Returns the growth along the motion from a start.
    ///
    /// # Errors
    /// [`Failure::Growth`]; [`Failure::Lacking`] where the copies do not start alike.
    pub(super) fn along(&self, start: &State<f64>) -> Result<Grown, Failure> {
        // Memory of derivatives is of one thread: each start has its own.
        let tangents = linearised(AbsoluteAngles(&self.tree));
        let system = BetweenCopies::new(tangents, self.copies.clone());
        if !self.copies.are_in_phase(&system, start) {
            return Err(Failure::Lacking {
                what: "the copies do not move alike: give them one angle and one rate by their \
                       common name, as in `--start child=10`, and nothing between them and other \
                       links that one of them lacks"
                    .to_owned(),
            });
        }
        Ok(self.growth.between_copies(&system, start)?)
    }

    pub(super) fn frequency_hz(&self) -> f64 {
        self.growth.frequency_hz
    }
}

/// One scan over the angles.
struct Scan {
    label: String,
    /// Frequency of a small difference at rest, Hz.
    frequency_hz: f64,
    angles_deg: Vec<f64>,
    grown: Vec<Grown>,
}

/// Computes the scans and writes them; Ctrl-C leaves those that are done.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job);
    let copies = arguments.pair.copies(&subject)?;
    let start = arguments.release.state(&subject)?;
    let scanned = match &arguments.link {
        Some(name) => subject.links_named(name)?,
        None => vec![0],
    };
    let trees = arguments.trees(&subject)?;
    let progress = job.progress(trees.len());
    let mut scans = Vec::new();
    for (label, tree) in trees {
        if job.is_interrupted() {
            break;
        }
        progress.begin(&label);
        let (horizons, tolerance) = (arguments.horizons.clone(), arguments.tolerance);
        let differences = Differences::new(&tree, &copies, horizons, tolerance)?;
        let starts = arguments.angles_deg.iter().map(|degrees| {
            let mut start = start.clone();
            for link in &scanned {
                start.values[*link] = degrees.to_radians();
            }
            start
        });
        let starts: Vec<State<f64>> = starts.collect();
        let grown = Ensemble::new().map(&starts, |_, start| differences.along(start));
        scans.push(Scan {
            label,
            frequency_hz: differences.frequency_hz(),
            angles_deg: arguments.angles_deg.clone(),
            grown: grown.into_iter().collect::<Result<_, _>>()?,
        });
        job.take_interruption();
        progress.advance(1.0);
    }
    if scans.is_empty() {
        return Ok(());
    }
    let link = &subject.tree.names()[scanned[0]];
    job.print(&report(arguments, &subject, link, &scans))?;
    write(job, arguments, &scans)?;
    let open = |scan: &Scan| {
        let is_open = |grown: &&Grown| !grown.factors.iter().all(Checked::is_determined);
        scan.grown.iter().filter(is_open).count()
    };
    job.report("undetermined", scans.iter().map(open).collect::<Vec<_>>());
    if scans[0].angles_deg.len() > 1 {
        job.chart("growth", &chart(arguments, &subject, link, &scans))?;
    }
    Ok(())
}

/// Most windows that a line tells; the table has all of them.
const MOST_WINDOWS: usize = 12;

fn report(arguments: &Arguments, subject: &Subject, link: &str, scans: &[Scan]) -> String {
    let mut text = format!(
        "{}: growth G(T) of a small difference between copies, released from rest at {} angles\n\
         of {link}; between them nothing was looked at\n",
        subject.name,
        arguments.angles_deg.len()
    );
    for scan in scans {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "\n{} (a small difference at rest: {:.4} Hz)",
            scan.label, scan.frequency_hz
        );
        let angles = &scan.angles_deg;
        let told = |found: Vec<[usize; 2]>| match found.len().checked_sub(MOST_WINDOWS) {
            None | Some(0) => words(&found, angles),
            Some(more) => format!("{}, and {more} more", words(&found[..MOST_WINDOWS], angles)),
        };
        for (number, horizon) in arguments.horizons.iter().enumerate() {
            let factor = |index: usize| scan.grown[index].factors[number];
            for level in &arguments.levels {
                let inside = windows(angles.len(), |index| factor(index).value >= *level);
                let _ = writeln!(
                    text,
                    "  {:20} {}",
                    format!("G({horizon} s) ≥ {level}"),
                    told(inside)
                );
            }
            let open = |index: usize| !factor(index).is_determined();
            let count = (0..scan.grown.len()).filter(|index| open(*index)).count();
            if count > 0 {
                let all = told(windows(angles.len(), open));
                let _ = writeln!(
                    text,
                    "  G({horizon} s) is not determined at {count} angles: {all}"
                );
            }
        }
    }
    text
}

fn write(job: &Job, arguments: &Arguments, scans: &[Scan]) -> Result<(), Failure> {
    let mut columns = vec![
        Column::new("tree", ""),
        Column::new("angle", "degrees"),
        Column::new("growth rate", "1/s"),
        Column::new("frequency of the difference", "Hz"),
    ];
    for horizon in &arguments.horizons {
        let name = format!("growth factor within {horizon} s");
        columns.push(Column::new(name.as_str(), ""));
        columns.push(Column::new(format!("{name} between tolerances"), ""));
    }
    job.csv("growth.csv", &columns, |csv| {
        for scan in scans {
            for (angle, grown) in scan.angles_deg.iter().zip(&scan.grown) {
                let own = [*angle, grown.rate.value, grown.frequency_hz.value];
                let factors = grown.factors.iter().flat_map(|f| [f.value, f.difference]);
                let numbers = own.into_iter().chain(factors).map(Cell::from);
                csv.row(std::iter::once(Cell::from(scan.label.as_str())).chain(numbers))?;
            }
        }
        Ok(())
    })
}

/// Growth factors that the chart shows. Lines lead out of it where there is more.
const SHOWN: [f64; 2] = [0.8, 1e6];

fn chart(arguments: &Arguments, subject: &Subject, link: &str, scans: &[Scan]) -> Chart {
    let ends = [0, arguments.angles_deg.len() - 1].map(|index| arguments.angles_deg[index]);
    let x = Axis::linear(format!("angle of {} at the release (°)", verbatim(link)))
        .range(ends[0], ends[1]);
    let height = 90.0 + 210.0 * arguments.horizons.len() as f64;
    let title = format!(
        "{}: growth of a small difference between copies",
        verbatim(&subject.name)
    );
    let chart = Chart::new(title, x).size(900.0, height);
    arguments
        .horizons
        .iter()
        .enumerate()
        .fold(chart, |chart, (number, horizon)| {
            let axis = Axis::log(format!("G({horizon} s)")).range(SHOWN[0], SHOWN[1]);
            let panel = scans.iter().fold(Panel::new(axis), |panel, scan| {
                let factors = scan
                    .grown
                    .iter()
                    .map(|grown| grown.factors[number].value.min(1e99));
                let factors: Vec<f64> = factors.collect();
                let label = verbatim(&scan.label);
                panel.series(Series::line(label, &scan.angles_deg, &factors).dash(Dash::Solid))
            });
            chart.panel(panel)
        })
}
