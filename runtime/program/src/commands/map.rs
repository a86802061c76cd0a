//! Growth rate of small differences between copies over a plane of two quantities.

use branched_pendulum::analysis::growth::{Grown, GrowthError};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use super::growth::{Differences, PairArguments};
use crate::Failure;
use crate::frame::Job;
use crate::frame::command_line::number;
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// Where in a plane do differences between copies grow, and how fast? Each axis is the
/// angle of a link at the start, or a parameter of the description; draws the growth rate
/// of a small difference beside the motion in phase, from rest.
///
/// Every value is computed at two tolerances; where they differ by more than 1 % it counts
/// as not determined, and is drawn all the same.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum map", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    pair: PairArguments,
    /// horizontal axis: a link with its angles in degrees, or a parameter with its values;
    /// all copies of a link have one name
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "NAME=FROM:TO:STEP",
        default_value = "child=-135:135:5",
        value_parser = AxisValues::read
    )]
    x: AxisValues,
    /// vertical axis, written alike
    #[arg(
        long,
        value_name = "NAME=FROM:TO:STEP",
        default_value = "parent=0:90:5",
        value_parser = AxisValues::read
    )]
    y: AxisValues,
    /// time followed, s from 1 to 1000
    #[arg(long, value_name = "S", default_value = "15", value_parser = number(1.0..=1000.0, "s"))]
    duration: f64,
    /// relative error of one integration step, 1e-12 to 1e-3; all is repeated with a
    /// hundredth of it, whose values are told
    #[arg(verbatim_doc_comment, long, value_name = "TOL", default_value = "1e-8", value_parser = number(1e-12..=1e-3, ""))]
    tolerance: f64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("map-output");
    const CHARTS: bool = true;

    fn check(&self) -> Result<(), String> {
        match self.x.name == self.y.name {
            true => Err(format!("both axes are `{}`: name another one", self.x.name)),
            false => Ok(()),
        }
    }
}

/// A quantity with the values that it takes along an axis.
#[derive(Clone, Debug, PartialEq)]
struct AxisValues {
    name: String,
    values: Vec<f64>,
}

/// Most values along an axis.
const MOST_VALUES: f64 = 2000.0;

impl AxisValues {
    fn read(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no axis: write `NAME=FROM:TO:STEP`, as in `parent=0:90:5`, with at \
                 most {MOST_VALUES} steps"
            )
        };
        let (name, range) = text.split_once('=').ok_or_else(wrong)?;
        let numbers: Vec<f64> = range
            .split(':')
            .map(|number| number.trim().parse().ok())
            .collect::<Option<_>>()
            .ok_or_else(wrong)?;
        let [from, to, step] = *numbers else {
            return Err(wrong());
        };
        let steps = ((to - from) / step + 1e-9).floor();
        if !(0.0..MOST_VALUES).contains(&steps) {
            return Err(wrong());
        }
        Ok(Self {
            name: name.trim().to_owned(),
            values: (0..=steps as u32)
                .map(|k| from + f64::from(k) * step)
                .collect(),
        })
    }
}

/// What the values of an axis are of.
enum Quantity {
    Parameter(String),
    Angles(Vec<usize>),
}

impl Quantity {
    fn of(subject: &Subject, axis: &AxisValues) -> Result<Self, Failure> {
        let description = subject.tree.description();
        let is_parameter = description.parameters().any(|own| own == axis.name);
        match (is_parameter, subject.links_named(&axis.name)) {
            (true, Err(_)) => Ok(Self::Parameter(axis.name.clone())),
            (false, Ok(links)) => Ok(Self::Angles(links)),
            (true, Ok(_)) => Err(Failure::Lacking {
                what: format!("`{}` is a link and a parameter: rename one", axis.name),
            }),
            (false, Err(_)) => {
                let parameters: Vec<&str> = description.parameters().collect();
                Err(Failure::Lacking {
                    what: format!(
                        "`{}` is neither a link ({}) nor a parameter ({})",
                        axis.name,
                        subject.tree.names().join(", "),
                        if parameters.is_empty() {
                            "there are none".to_owned()
                        } else {
                            parameters.join(", ")
                        }
                    ),
                })
            }
        }
    }

    fn unit(&self) -> &'static str {
        match self {
            Self::Parameter(_) => "",
            Self::Angles(_) => "degrees",
        }
    }
}

/// Points that are computed between two looks at Ctrl-C.
const BLOCK: usize = 256;

/// Growth rates between which colours change, 1/s.
const RATES: [f64; 2] = [0.01, 5.0];

/// What is asked at every point of the plane.
struct Question<'a> {
    arguments: &'a Arguments,
    subject: &'a Subject,
    copies: Copies,
    start: State<f64>,
    quantities: [Quantity; 2],
}

/// A point of the plane with the growth there.
type Point = ([f64; 2], Grown);

impl Question<'_> {
    /// Returns the growth at a point; none where the motion could not be followed.
    fn at(&self, point: &[f64; 2]) -> Result<Option<Grown>, Failure> {
        let (mut tree, mut start) = (self.subject.tree.clone(), self.start.clone());
        for (quantity, &value) in self.quantities.iter().zip(point) {
            match quantity {
                Quantity::Parameter(name) => {
                    let changed = tree.with(name, value);
                    tree = changed.map_err(|source| Failure::Tree {
                        name: self.subject.name.clone(),
                        source,
                    })?;
                }
                Quantity::Angles(links) => {
                    for link in links {
                        start.values[*link] = value.to_radians();
                    }
                }
            }
        }
        let (horizons, tolerance) = (vec![self.arguments.duration], self.arguments.tolerance);
        match Differences::new(&tree, &self.copies, horizons, tolerance)?.along(&start) {
            Ok(grown) => Ok(Some(grown)),
            Err(Failure::Growth(GrowthError::Integration(_))) => Ok(None),
            Err(failure) => Err(failure),
        }
    }

    /// Label of an axis in the chart.
    fn label(&self, axis: usize) -> String {
        let name = &[&self.arguments.x, &self.arguments.y][axis].name;
        match self.quantities[axis] {
            Quantity::Parameter(_) => name.clone(),
            Quantity::Angles(_) => format!("angle of {name} at the release (°)"),
        }
    }
}

/// Computes the map and writes it; Ctrl-C leaves the points that are done.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job);
    // A tree without copies has no map at all, whatever the axes.
    let copies = arguments.pair.copies(&subject)?;
    let question = Question {
        arguments,
        subject: &subject,
        copies,
        start: arguments.release.state(&subject)?,
        quantities: [
            Quantity::of(&subject, &arguments.x)?,
            Quantity::of(&subject, &arguments.y)?,
        ],
    };
    let rows = arguments.y.values.iter();
    let points: Vec<[f64; 2]> = rows
        .flat_map(|&y| arguments.x.values.iter().map(move |&x| [x, y]))
        .collect();
    let progress = job.progress(points.len());
    progress.begin("points of the map");
    let (mut all, mut found) = (0, Vec::new());
    for block in points.chunks(BLOCK) {
        if job.is_interrupted() {
            break;
        }
        let grown = Ensemble::new().map(block, |_, point| question.at(point));
        for (point, grown) in block.iter().zip(grown) {
            all += 1;
            found.extend(grown?.map(|grown| (*point, grown)));
        }
        job.take_interruption();
        progress.advance(block.len() as f64);
    }
    if all == 0 {
        return Ok(());
    }
    job.print(&report(&subject, &found, all))?;
    write(job, &question, &found)?;
    let is_line = [&arguments.x, &arguments.y].map(|axis| axis.values.len() < 2);
    match found.is_empty() || is_line.contains(&true) {
        true => Ok(()),
        false => job.chart("map", &chart(&question, &found)),
    }
}

fn write(job: &Job, question: &Question<'_>, found: &[Point]) -> Result<(), Failure> {
    let names = [&question.arguments.x, &question.arguments.y].map(|axis| axis.name.as_str());
    let [x, y] = [0, 1].map(|axis| Column::new(names[axis], question.quantities[axis].unit()));
    let columns = [
        x,
        y,
        Column::new("growth rate", "1/s"),
        Column::new("growth rate between tolerances", ""),
        Column::new("growth factor", ""),
        Column::new("frequency of the difference", "Hz"),
    ];
    job.csv("map.csv", &columns, |csv| {
        found.iter().try_for_each(|([x, y], grown)| {
            let factor = grown.factors.first();
            let factor = factor.map_or(f64::NAN, |factor| factor.value);
            let (rate, frequency) = (grown.rate, grown.frequency_hz.value);
            csv.row([*x, *y, rate.value, rate.difference, factor, frequency].map(Cell::from))
        })
    })
}

fn chart(question: &Question<'_>, found: &[Point]) -> Chart {
    let [x, y] = [0, 1].map(|axis| {
        let places = found.iter().map(|(point, _)| point[axis]);
        places.collect::<Vec<f64>>()
    });
    let rates: Vec<f64> = found.iter().map(|(_, grown)| grown.rate.value).collect();
    let panel = Panel::new(Axis::linear(question.label(1))).series(Series::shaded(&x, &y, &rates));
    let name = &question.subject.name;
    let title = format!("{name}: growth rate of a difference between copies");
    let colors = Axis::log("growth rate (1/s)").range(RATES[0], RATES[1]);
    let chart = Chart::new(title, Axis::linear(question.label(0))).panel(panel);
    chart.colors(colors).size(960.0, 720.0)
}

fn report(subject: &Subject, found: &[Point], all: usize) -> String {
    let share = |inside: &dyn Fn(f64) -> bool| {
        let some = found.iter().filter(|(_, grown)| inside(grown.rate.value));
        100.0 * some.count() as f64 / found.len().max(1) as f64
    };
    let open = found
        .iter()
        .filter(|(_, grown)| !grown.rate.is_determined());
    let lost = match all - found.len() {
        0 => String::new(),
        lost => format!("; {lost} could not be followed"),
    };
    format!(
        "{}: {} points, {:.1} % with a growth rate below {} 1/s, {:.1} % with one above 1 1/s.\n\
         At {} the two tolerances differ by more than 1 %{lost}.\n",
        subject.name,
        found.len(),
        share(&|rate| rate < RATES[0]),
        RATES[0],
        share(&|rate| rate > 1.0),
        open.count(),
    )
}
