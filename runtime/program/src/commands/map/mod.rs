//! Maps of a quantity over a plane of two others: growth rates, or times of flips.

mod bound;
mod flips;
mod normal_modes;
mod rates;
mod tongues;

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use branched_pendulum_data::Cell;
use clap::{Parser, ValueEnum};

use self::flips::Flips;
use self::rates::Rates;
use super::differences::PairArguments;
use super::plane::{AxisValues, MapPlane, Point, Question};
use super::predicted::Theory;
use crate::Failure;
use crate::frame::command_line::{number, parts};
use crate::frame::{Charts, Job};
use crate::release::ReleaseArguments;
use crate::subject::TreeArguments;

/// Maps over a plane how fast differences between copies grow, or when a link first flips. Each
/// axis is the angle of a link at the start, or a parameter of the description. Draws the growth
/// rate of a small difference along the in-phase motion, or the time until the first flip; motions
/// start at rest.
///
/// Of a tree that mirrors itself, twice the frequency of a difference that grows is a sum
/// of whole multiples of those of the motion in phase: `--tongues` lists where it grows,
/// with the multiples.
///
/// A link flips when its angle passes an odd multiple of 180°: it then points opposite to its
/// direction at angle zero. The time is that of the first link that does so. A link that starts
/// there flips when it comes back.
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
    /// quantity that is computed at every point
    #[arg(long, value_enum, value_name = "QUANTITY", default_value_t = Of::Growth)]
    of: Of,
    #[command(flatten)]
    pair: PairArguments,
    /// flip: names of the links whose flips count; by default all links
    #[arg(long, value_name = "LINK[,..]")]
    link: Option<String>,
    /// horizontal axis: a link with its angles in degrees, or a parameter with its values;
    /// a name stands for all copies of a link; links joined by `+` have the same angle
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "NAME=FROM:TO:STEP",
        default_value = "child=-135:135:5",
        value_parser = AxisValues::read
    )]
    x: AxisValues,
    /// vertical axis, in the same form as `--x`; instead of a step, `xRATIO` is the ratio of
    /// neighbouring values
    #[arg(
        long,
        value_name = "NAME=FROM:TO:STEP",
        default_value = "parent=0:90:5",
        value_parser = AxisValues::read
    )]
    y: AxisValues,
    /// growth: draws the nonlinear normal modes of the in-phase motion, if the axes are the release
    /// angles of its only two angles
    #[arg(verbatim_doc_comment, long)]
    modes: bool,
    /// growth: lists the tongues of instability on lines across the plane, at these values of one
    /// axis; motions on these lines are integrated eight times as long
    #[arg(verbatim_doc_comment, long, value_name = "NAME=VALUE[,VALUE]...", value_parser = AxisValues::read_values)]
    tongues: Vec<AxisValues>,
    /// growth: also predicts the tongues on these lines by the normal form of degree 8, and draws
    /// their edges
    #[arg(verbatim_doc_comment, long, requires = "tongues")]
    theory: bool,
    /// points that the map marks
    #[arg(long, value_name = "X:Y[,X:Y]...", value_parser = points, allow_hyphen_values = true)]
    mark: Option<::std::vec::Vec<Point>>,
    /// duration of each motion, s from 1 to 1000
    #[arg(long, value_name = "S", default_value = "15", value_parser = number(1.0..=1000.0, "s"))]
    duration: f64,
    /// relative error of one integration step, 1e-12 to 1e-3; everything is repeated with a
    /// hundredth of it, and the values of the repetition are reported
    #[arg(verbatim_doc_comment, long, value_name = "TOL", default_value = "1e-8", value_parser = number(1e-12..=1e-3, ""))]
    tolerance: f64,
}

/// Quantity that a map shows at every point of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Of {
    /// Growth rate of a small difference between copies, 1/s.
    Growth,
    /// Time until a link first flips (turns over), s.
    Flip,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("map-output");
    const CHARTS: Charts = Charts::Any;

    fn check(&self) -> Result<(), String> {
        if self.x.name == self.y.name {
            return Err(format!(
                "both axes are `{}`: choose another name for one of them",
                self.x.name
            ));
        }
        if self.of == Of::Flip && (self.modes || !self.tongues.is_empty()) {
            return Err(
                "`--modes` and `--tongues` apply only to a map of growth: leave them out, or add \
                 `--of growth`"
                    .to_owned(),
            );
        }
        match self.of {
            Of::Growth if self.link.is_some() => {
                Err("`--link` names the links whose flips count: add `--of flip`".to_owned())
            }
            Of::Flip if self.pair.is_given() => Err(
                "`--pair` applies only to a map of growth: leave it out, or add `--of growth`"
                    .to_owned(),
            ),
            Of::Growth | Of::Flip => Ok(()),
        }
    }
}

/// Reads points `X:Y`.
fn points(text: &str) -> Result<Vec<Point>, String> {
    let point = |part: &str| {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let both = part.split_once(':');
        let both = both.and_then(|(x, y)| Some([number(x)?, number(y)?]));
        both.ok_or_else(|| format!("`{part}` is not a point `X:Y`"))
    };
    parts(text).map(point).collect()
}

/// Computes the map and writes it; after Ctrl-C, the completed points are written.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let (duration, tolerance) = (arguments.duration, arguments.tolerance);
    let plane = || {
        let start = arguments.release.state(&subject)?;
        MapPlane::new(&subject, start, [&arguments.x, &arguments.y])
    };
    match arguments.of {
        Of::Growth => {
            // A tree without copies has no such map, with any axes.
            let copies = arguments.pair.copies(&subject)?;
            let plane = &plane()?;
            if arguments.modes {
                normal_modes::check(plane)?;
            }
            let lines = arguments.tongues.iter().map(|line| plane.lines(line));
            let theory = Theory {
                options: NormalFormOptions::default(),
                copies: &copies,
                name: &subject.name,
                least: 0.0,
            };
            let rates = Rates {
                plane,
                copies: &copies,
                theory: arguments.theory.then_some(theory),
                predicted: Vec::new(),
                duration,
                tolerance,
                marked: arguments.mark.as_deref().unwrap_or_default(),
                lines: lines.collect::<Result<Vec<_>, _>>()?.concat(),
                with_modes: arguments.modes,
                modes: Vec::new(),
                tongues: Vec::new(),
            };
            answer(job, plane, rates)
        }
        Of::Flip => {
            let links = match &arguments.link {
                None => (0..subject.tree.names().len()).collect(),
                Some(names) => subject.all_links_named(names)?,
            };
            let plane = &plane()?;
            let flips = Flips {
                plane,
                links,
                duration,
                tolerance,
                marked: arguments.mark.as_deref().unwrap_or_default(),
                excess: Vec::new(),
            };
            answer(job, plane, flips)
        }
    }
}

/// Computes the answer to a question at all points of the plane, and writes the results.
fn answer<Q: Question>(job: &Job, plane: &MapPlane<'_>, mut question: Q) -> Result<(), Failure> {
    let points = plane.points();
    let progress = job.progress(points.len());
    progress.begin("points of the map");
    let (mut all, mut found) = (0, Vec::new());
    for block in points.chunks(Q::BLOCK) {
        if job.is_interrupted() {
            break;
        }
        let answers = question.at(block)?;
        all += answers.len();
        let both = block.iter().zip(answers);
        found.extend(both.filter_map(|(point, answer)| Some((*point, answer?))));
        job.take_interruption();
        progress.advance(block.len() as f64);
    }
    if all == 0 {
        return Ok(());
    }
    question.complete(job)?;
    job.print(&question.report(&found, all - found.len()))?;
    for (name, count) in question.record(&found) {
        job.report(name, count);
    }
    write(job, plane, &question, &found)?;
    match found.is_empty() || !plane.is_plane() {
        true => Ok(()),
        false => job.chart("map", &question.chart(&found)),
    }
}

fn write<Q: Question>(
    job: &Job,
    plane: &MapPlane<'_>,
    question: &Q,
    found: &[(Point, Q::Answer)],
) -> Result<(), Failure> {
    let columns: Vec<_> = plane
        .columns()
        .into_iter()
        .chain(question.columns())
        .collect();
    job.csv("map.csv", &columns, |csv| {
        found.iter().try_for_each(|(point, answer)| {
            let place = point.iter().map(Cell::from);
            csv.row(place.chain(question.row(answer)))
        })
    })
}
