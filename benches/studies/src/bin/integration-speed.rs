//! Program that measures the cost of computing a trajectory to a given error.
//!
//! `integration-speed --help` says what is measured.

use std::cell::RefCell;
use std::error::Error;
use std::process::ExitCode;

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::{self as frame, Job, Progress};
use branched_pendulum_studies::integration_speed::ensemble::{
    Speed, friction_scan, near_threshold, scan_speeds, speeds,
};
use branched_pendulum_studies::integration_speed::measure::{ERRORS, Point, points, time_for};
use branched_pendulum_studies::scenes::{BranchedDouble, FifteenRods, Rods, ThirtyOneRods};
use branched_pendulum_studies::work_precision::reference::{Problem, Tree, problems};
use clap::{Parser, ValueEnum};

/// How long does a motion of ten seconds take, to a given error at its end, by the
/// generated Taylor series and by two Runge-Kutta methods? Microseconds, the least
/// of all tolerances that reach the error. benches/peers measures the same motions
/// with heyoka.
#[derive(Parser)]
#[command(name = "integration-speed", version, verbatim_doc_comment)]
struct Arguments {
    /// what is measured
    #[arg(value_name = "PART", default_value = "motions")]
    part: Part,
}

#[derive(Clone, Copy, ValueEnum)]
enum Part {
    /// the paper's pendulum and seven rods
    Motions,
    /// trajectories a second near the threshold and of many frictions
    Ensemble,
    /// fifteen and thirty-one rods, against the series at 1e-16
    Trees,
}

impl frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = None;
}

/// Runs of each tolerance.
const REPEATS: usize = 25;

/// Duration of the problems that are measured, in s; the others are left out.
const END: f64 = 10.0;

fn main() -> ExitCode {
    frame::main(|arguments: &Arguments, job| {
        let output = Output {
            job,
            text: RefCell::default(),
        };
        match arguments.part {
            Part::Motions => motions(&output),
            Part::Ensemble => ensemble(&output),
            Part::Trees => trees(&output),
        }?;
        job.write("integration-speed.txt", output.text.borrow().as_bytes())
    })
}

/// Prints text and also stores it for the file.
struct Output<'a> {
    job: &'a Job,
    text: RefCell<String>,
}

impl Output<'_> {
    fn line(&self, text: &str) -> Result<(), Failure> {
        let line = format!("{text}\n");
        self.text.borrow_mut().push_str(&line);
        self.job.print(&line)
    }
}

/// Returns the error if a motion fails that is not described by one angle of release.
fn failed(error: impl Error + Send + Sync + 'static) -> Failure {
    Failure::integration(0.0, error)
}

fn ensemble(output: &Output) -> Result<(), Failure> {
    let (tolerance, count, repeats) = (1e-9, 10_000, 5);
    output.line(&format!(
        "{END} s, tolerance {tolerance:e}, on one thread, trajectories a second"
    ))?;
    let progress = output.job.progress(2);
    let starts = near_threshold(count);
    progress.begin("starts");
    output.line(&format!("{count} starts"))?;
    print_speeds(
        output,
        &speeds(&starts, END, tolerance, repeats).map_err(failed)?,
    )?;
    progress.next();
    let releases = friction_scan(count)?;
    progress.begin("frictions");
    output.line(&format!("{count} frictions"))?;
    print_speeds(
        output,
        &scan_speeds(&releases, END, tolerance, repeats).map_err(failed)?,
    )
}

fn print_speeds(output: &Output, speeds: &[Speed]) -> Result<(), Failure> {
    let first = speeds.first().map_or(f64::NAN, |first| first.per_second);
    speeds.iter().try_for_each(|Speed { way, per_second }| {
        let times = per_second / first;
        output.line(&format!(
            "  {way:18} {per_second:>8.0}, {times:5.2} times the first"
        ))
    })
}

fn trees(output: &Output) -> Result<(), Failure> {
    heading(output)?;
    let progress = output.job.progress(2);
    let (fifteen, thirty_one) = (FifteenRods::new(), ThirtyOneRods::new());
    tree(
        output,
        "fifteen rods, 10 s",
        &AbsoluteAngles(&fifteen),
        &progress,
    )?;
    tree(
        output,
        "thirty-one rods, 10 s",
        &AbsoluteAngles(&thirty_one),
        &progress,
    )
}

/// Measures a tree of rods, released from rest with the root at 0.08 rad and the others within 0.01
/// rad of the vertical.
fn tree<O: TaylorOde<f64>>(
    output: &Output,
    name: &'static str,
    ode: &O,
    progress: &Progress,
) -> Result<(), Failure> {
    let angle = |link: usize| match link {
        0 => 0.08,
        _ => 0.005 * ((7 * link % 5) as f64 - 2.0),
    };
    let start: Vec<f64> = (0..ode.dimension() / 2).map(angle).collect();
    let options = Options {
        compensated: true,
        ..Options::with_tolerance(1e-16)
    };
    let state = State::at_rest(0.0, &start);
    let end = Taylor::new(options).sample(ode, &state, &[END], |_, _| {});
    let problem = Problem {
        name,
        tree: Tree::Rods,
        start,
        end: END,
        expected: end.map_err(failed)?.state.values,
    };
    rows(output, ode, &problem, 3, progress)
}

fn heading(output: &Output) -> Result<(), Failure> {
    let errors = ERRORS.map(|error| format!("{error:>9.0e}"));
    output.line(&format!("{:32}{}", "error", errors.concat()))
}

fn motions(output: &Output) -> Result<(), Failure> {
    heading(output)?;
    let problems = problems(&[END])?;
    let progress = output.job.progress(problems.len());
    for problem in &problems {
        match problem.tree {
            Tree::Paper => {
                let model = BranchedDouble::new();
                rows(output, &AbsoluteAngles(&model), problem, REPEATS, &progress)?;
            }
            Tree::Rods => {
                let model = Rods::new();
                rows(output, &AbsoluteAngles(&model), problem, REPEATS, &progress)?;
            }
        }
    }
    Ok(())
}

/// Measures one problem and prints its rows, as a part of `progress`.
fn rows<O: TaylorOde<f64>>(
    output: &Output,
    ode: &O,
    problem: &Problem,
    repeats: usize,
    progress: &Progress,
) -> Result<(), Failure> {
    let options = |tolerance| Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    };
    progress.begin(problem.name);
    let row = |method: &str, points: Result<Vec<Point>, IntegrationError<f64>>| {
        let points = points.map_err(failed)?;
        progress.advance(1.0 / 3.0);
        let times = ERRORS.map(|error| match time_for(&points, error) {
            Some(micros) => format!("{micros:>9.0}"),
            None => format!("{:>9}", "-"),
        });
        let name = format!("{}, {method}", problem.name);
        output.line(&format!("{name:32}{}", times.concat()))
    };
    let taylor = |tolerance| Taylor::new(options(tolerance));
    row("Taylor", points(ode, problem, repeats, taylor))?;
    let dop853 = |tolerance| Dop853::new(options(tolerance));
    row("Dop853", points(ode, problem, repeats, dop853))?;
    let verner98 = |tolerance| Verner98::new(options(tolerance));
    row("Verner98", points(ode, problem, repeats, verner98))
}
