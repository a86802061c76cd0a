//! Error against computing time for every method, on a given tree.

use branched_pendulum::prelude::*;
use branched_pendulum::scalar::Double;
use branched_pendulum_advice::{KnownEnd, MethodRun, WorkPrecision};
use branched_pendulum_charts::{Axis, Chart, Panel, Series, verbatim};
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use crate::Failure;
use crate::frame::command_line::number;
use crate::frame::{Charts, Job};
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// Which integration method is the cheapest on this tree for a given error? Runs every method with
/// many tolerances or steps, compares it with a reference of twice the digits, and draws the error
/// at the end against computing time and against the number of evaluations.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum methods", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    /// duration of the motion, s from 0.1 to 1000
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.1..=1000.0, "s"))]
    duration: f64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("methods-output");
    const CHARTS: Charts = Charts::Any;
}

/// Errors in the table.
const LEVELS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-11, 1e-13];

/// Measures all methods, and prints, writes and draws the results.
///
/// # Errors
/// [`Failure`]; [`Failure::Lacking`] if the motion is so chaotic that no digit can be computed.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let start = arguments.release.state(&subject)?;
    let progress = job.progress(2);
    progress.begin("reference in twice the digits");
    let end = arguments.duration;
    let wide = subject.tree.cast(Double::from_f64);
    let known = KnownEnd::of(&AbsoluteAngles(&wide), &start, end).map_err(Failure::advice)?;
    let uncertainty = known.uncertainty;
    if uncertainty > LEVELS[0] {
        return Err(Failure::Lacking {
            what: format!(
                "the end of this motion is known only to {uncertainty:.0e} rad, even with twice \
                 the digits: use a shorter `--duration`"
            ),
        });
    }
    progress.next();
    let reported = |method: Method, part| {
        progress.show_message(method.title());
        progress.within(1, part);
    };
    let system = AbsoluteAngles(&subject.tree);
    let methods = WorkPrecision::METHODS;
    let measured = WorkPrecision::measure(&system, &start, end, &known.values, &methods, reported);
    let table = measured.table(&LEVELS);
    job.print(&format!(
        "{}: time (µs) to an error at the end, rad or rad/s; * the shortest\n\
         (the reference is known to {uncertainty:.0e})\n\n{table}",
        subject.name
    ))?;
    write(job, &subject, &measured)
}

fn write(job: &Job, subject: &Subject, measured: &WorkPrecision) -> Result<(), Failure> {
    let columns = [
        Column::new("method", ""),
        Column::new("tolerance or step", ""),
        Column::new("error", "rad or rad/s"),
        Column::new("time", "us"),
        Column::new("evaluations", ""),
    ];
    job.csv("methods.csv", &columns, |csv| {
        measured.runs().iter().try_for_each(|run| {
            csv.row([
                Cell::from(run.method.title()),
                run.setting.into(),
                run.error.into(),
                (run.seconds * 1e6).into(),
                run.evaluations.into(),
            ])
        })
    })?;
    let chart = |x: &str, of: &dyn Fn(&MethodRun) -> f64| {
        let error = Axis::log("error at the end (rad or rad/s)").range(1e-15, 10.0);
        let methods = measured.methods().into_iter();
        let panel = methods.fold(Panel::new(error), |panel, method| {
            let own = measured.runs_of(method);
            let (x, y): (Vec<f64>, Vec<f64>) =
                own.map(|run| (of(run), run.error.max(1e-15))).unzip();
            panel.series(Series::line(method.title(), &x, &y).with_symbols())
        });
        Chart::new(verbatim(&subject.name), Axis::log(x))
            .panel(panel)
            .size(900.0, 600.0)
    };
    job.chart(
        "methods-time",
        &chart("time (µs)", &|run| run.seconds * 1e6),
    )?;
    job.chart(
        "methods-evaluations",
        &chart("evaluations (of Taylor: orders)", &|run| {
            run.evaluations as f64
        }),
    )
}
