//! Error against time for every method, on the tree that is asked about.

use std::fmt::Write;
use std::time::{Duration, Instant};

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum::system::RatesOnly;
use branched_pendulum_charts::{Axis, Chart, Panel, Series, verbatim};
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use crate::Failure;
use crate::frame::command_line::number;
use crate::frame::{Job, Progress};
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// Which method is the cheapest for an error on this tree? Runs every method at many
/// tolerances or steps against a reference in numbers of twice the digits, and draws
/// the error at the end against time and against evaluations.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum methods", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    /// time followed, s from 0.1 to 1000
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.1..=1000.0, "s"))]
    duration: f64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("methods-output");
    const CHARTS: bool = true;
}

const METHODS: [Method; 7] = [
    Method::Rk4,
    Method::Dopri5,
    Method::Dop853,
    Method::Verner98,
    Method::Gauss(GaussOrder::Four),
    Method::Gauss(GaussOrder::Six),
    Method::Gauss(GaussOrder::Eight),
];

/// Errors in the table.
const LEVELS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-11, 1e-13];

/// One run of a method.
struct Measurement {
    method: Method,
    setting: f64,
    error: f64,
    microseconds: f64,
    evaluations: u64,
}

/// Measures all methods, and prints, writes and draws what was found.
///
/// # Errors
/// [`Failure`]; [`Failure::Lacking`] for a chaotic motion of which no digit is left.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job);
    let start = arguments.release.state(&subject)?;
    let progress = job.progress(METHODS.len() + 1);
    progress.begin("reference in twice the digits");
    let (expected, known) = reference(&subject, &start, arguments.duration)?;
    if known > LEVELS[0] {
        return Err(Failure::Lacking {
            what: format!(
                "the end of this motion is known to {known:.0e} rad alone, even in twice the digits: \
                 take a shorter `--duration`"
            ),
        });
    }
    progress.advance(1.0);
    let runs = measure(&subject, &start, arguments.duration, &expected, &progress);
    job.print(&table(&subject, &runs, known))?;
    write(job, &subject, &runs)
}

/// State at the end, and how well it is known: by two tolerances in double-double numbers.
fn reference(subject: &Subject, start: &State<f64>, end: f64) -> Result<(Vec<f64>, f64), Failure> {
    let tree = subject.tree.cast(Double::from_f64);
    let start = State::new(
        Double::from_f64(start.time),
        start.values.iter().copied().map(Double::from_f64).collect(),
    );
    let run = |tolerance: f64| {
        let method = Verner98::new(Options::with_tolerance(Double::from_f64(tolerance)));
        let system = AbsoluteAngles(&tree);
        let observer = |_: &mut DenseStep<'_, Double>| ControlFlow::Continue(());
        let solution = method.integrate(&system, &start, Double::from_f64(end), observer);
        let solution = solution.map_err(|error| Failure::Motion(Box::new(error)))?;
        let values = solution.state.values.iter();
        Ok::<Vec<f64>, Failure>(values.map(|value| value.high()).collect())
    };
    let [coarse, fine] = [1e-17, 1e-19].map(run);
    let (coarse, fine) = (coarse?, fine?);
    let known = difference(&coarse, &fine);
    Ok((fine, known))
}

fn difference(one: &[f64], other: &[f64]) -> f64 {
    let both = one.iter().zip(other);
    both.fold(0.0, |most, (one, other)| most.max((one - other).abs()))
}

/// Tolerances or steps of a method, from loose to tight.
fn settings(method: Method) -> Vec<f64> {
    let steps = |longest: f64, count: i32| {
        let halves = |k| longest * 0.5_f64.powf(0.5 * f64::from(k));
        (0..count).map(halves).collect()
    };
    match method {
        _ if method.is_adaptive() => (6..=28)
            .map(|k| 10.0_f64.powf(-0.5 * f64::from(k)))
            .collect(),
        Method::Rk4 => steps(0.02, 14),
        _ => steps(0.08, 11),
    }
}

fn measure(
    subject: &Subject,
    start: &State<f64>,
    end: f64,
    expected: &[f64],
    progress: &Progress,
) -> Vec<Measurement> {
    let system = AbsoluteAngles(&subject.tree);
    let mut all = Vec::new();
    for method in METHODS {
        progress.begin(method.title());
        let settings = settings(method);
        for &setting in &settings {
            progress.advance(1.0 / settings.len() as f64);
            let run = || {
                let observer = |_: &mut DenseStep<'_, f64>| ControlFlow::Continue(());
                let method = method.with(setting).with_step_limit(2_000_000);
                method.integrate(&RatesOnly(&system), start, end, observer)
            };
            // A step that is too long fails, and shows as none.
            let Ok(solution) = run() else {
                continue;
            };
            all.push(Measurement {
                method,
                setting,
                error: difference(&solution.state.values, expected),
                microseconds: shortest(run),
                evaluations: solution.report.evaluations,
            });
        }
    }
    all
}

/// The shortest time of repeated runs, µs: what disturbs a run only lengthens it.
fn shortest<R>(run: impl Fn() -> R) -> f64 {
    let (mut best, mut spent, mut runs) = (Duration::MAX, Duration::ZERO, 0);
    while runs < 3 || (spent < Duration::from_millis(20) && runs < 1000) {
        let begin = Instant::now();
        std::hint::black_box(run());
        let time = begin.elapsed();
        best = best.min(time);
        spent += time;
        runs += 1;
    }
    best.as_secs_f64() * 1e6
}

/// Time of the fastest run of a method with at most this error, µs.
fn time_to_error(runs: &[Measurement], method: Method, error: f64) -> Option<f64> {
    let good = runs
        .iter()
        .filter(|run| run.method == method && run.error <= error);
    good.map(|run| run.microseconds).reduce(f64::min)
}

fn table(subject: &Subject, runs: &[Measurement], known: f64) -> String {
    let mut text = format!(
        "{}: time (µs) to an error at the end, rad or rad/s; * the shortest\n\
         (the reference is known to {known:.0e})\n\n{:24}",
        subject.name, ""
    );
    for level in LEVELS {
        // Writing to a string cannot fail.
        let _ = write!(text, "{level:>10e} ");
    }
    text.push('\n');
    let times = METHODS.map(|method| LEVELS.map(|level| time_to_error(runs, method, level)));
    for (method, row) in METHODS.iter().zip(&times) {
        let _ = write!(text, "{:24}", method.title());
        for (column, time) in row.iter().enumerate() {
            let best = times
                .iter()
                .filter_map(|row| row[column])
                .fold(f64::INFINITY, f64::min);
            let _ = match *time {
                Some(time) if time == best => write!(text, "{time:10.0}*"),
                Some(time) => write!(text, "{time:10.0} "),
                None => write!(text, "{:>10} ", "-"),
            };
        }
        text.push('\n');
    }
    text
}

fn write(job: &Job, subject: &Subject, runs: &[Measurement]) -> Result<(), Failure> {
    let columns = [
        Column::new("method", ""),
        Column::new("tolerance or step", ""),
        Column::new("error", "rad or rad/s"),
        Column::new("time", "us"),
        Column::new("evaluations", ""),
    ];
    job.csv("methods.csv", &columns, |csv| {
        runs.iter().try_for_each(|run| {
            csv.row([
                Cell::from(run.method.title()),
                run.setting.into(),
                run.error.into(),
                run.microseconds.into(),
                run.evaluations.into(),
            ])
        })
    })?;
    let chart = |x: &str, of: &dyn Fn(&Measurement) -> f64| {
        let error = Axis::log("error at the end (rad or rad/s)").range(1e-15, 10.0);
        let panel = METHODS.iter().fold(Panel::new(error), |panel, method| {
            let own = runs.iter().filter(|run| run.method == *method);
            let (x, y): (Vec<f64>, Vec<f64>) =
                own.map(|run| (of(run), run.error.max(1e-15))).unzip();
            match x.is_empty() {
                true => panel,
                false => panel.series(Series::line(method.title(), &x, &y).with_symbols()),
            }
        });
        Chart::new(verbatim(&subject.name), Axis::log(x))
            .panel(panel)
            .size(900.0, 600.0)
    };
    job.chart("methods-time", &chart("time (µs)", &|run| run.microseconds))?;
    job.chart(
        "methods-evaluations",
        &chart("evaluations", &|run| run.evaluations as f64),
    )
}
