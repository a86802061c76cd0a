//! What a trajectory to a given error costs.
//!
//! `integration-speed --help` says what is measured.

use std::error::Error;
use std::process::ExitCode;

use branched_pendulum::prelude::*;
use branched_pendulum::system::TaylorOde;
use branched_pendulum_examples::exit;
use branched_pendulum_examples::integration_speed::ensemble::{
    Speed, friction_scan, near_threshold, scan_speeds, speeds,
};
use branched_pendulum_examples::integration_speed::measure::{ERRORS, points, time_for};
use branched_pendulum_examples::solvers::scenes::{FifteenRods, Ideal, Rods, ThirtyOneRods};
use branched_pendulum_examples::work_precision::reference::{Problem, Tree, problems};

const HELP: &str = "\
How long does a motion of ten seconds take, to a given error at its end, by the
generated Taylor series and by two Runge-Kutta methods? Microseconds, the least
of all tolerances that reach the error. benches/peers measures the same motions
with heyoka.

With `ensemble`: how many trajectories of the paper's pendulum a second, released
at angles near its threshold, one by one and in the lanes of vector registers?
And how many of pendulums each of which has a friction of its own?

With `trees`: the same of fifteen and of thirty-one rods, whose errors are the
differences from the series at a tolerance of 1e-16.

Usage: integration-speed [ensemble | trees]

  --help  this text
";

/// Runs of each tolerance.
const REPEATS: usize = 25;

/// Of the problems, those of this duration, in seconds.
const END: f64 = 10.0;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        [] => report(run()),
        ["ensemble"] => report(ensemble()),
        ["trees"] => report(trees()),
        ["--help" | "-h"] => {
            print!("{HELP}");
            ExitCode::SUCCESS
        }
        _ => exit::wrong_command_line(
            "integration-speed",
            &"takes no argument but `ensemble`, `trees` or --help",
        ),
    }
}

fn report(end: Result<(), Box<dyn Error>>) -> ExitCode {
    match end {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("integration-speed: {error}");
            ExitCode::FAILURE
        }
    }
}

fn ensemble() -> Result<(), Box<dyn Error>> {
    let (tolerance, count, repeats) = (1e-9, 10_000, 5);
    println!("{END} s, tolerance {tolerance:e}, on one thread, trajectories a second");
    let starts = near_threshold(count);
    println!("{count} starts");
    print_speeds(&speeds(&starts, END, tolerance, repeats)?);
    let releases = friction_scan(count)?;
    println!("{count} frictions");
    print_speeds(&scan_speeds(&releases, END, tolerance, repeats)?);
    Ok(())
}

fn print_speeds(speeds: &[Speed]) {
    let first = speeds.first().map_or(f64::NAN, |first| first.per_second);
    for Speed { way, per_second } in speeds {
        let times = per_second / first;
        println!("  {way:18} {per_second:>8.0}, {times:5.2} times the first");
    }
}

fn trees() -> Result<(), Box<dyn Error>> {
    heading();
    let (fifteen, thirty_one) = (FifteenRods::new(), ThirtyOneRods::new());
    tree("fifteen rods, 10 s", &AbsoluteAngles(&fifteen))?;
    tree("thirty-one rods, 10 s", &AbsoluteAngles(&thirty_one))
}

/// Rods at rest, the root at 0.08 rad, the others within 0.01 rad of the vertical.
fn tree<O: TaylorOde<f64>>(name: &'static str, ode: &O) -> Result<(), Box<dyn Error>> {
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
    let end = Taylor::new(options).sample(ode, &state, &[END], |_, _| {})?;
    let problem = Problem {
        name,
        tree: Tree::Rods,
        start,
        end: END,
        expected: end.state.values,
    };
    rows(ode, &problem, 3)
}

fn heading() {
    print!("{:32}", "error");
    for error in ERRORS {
        print!("{error:>9.0e}");
    }
    println!();
}

fn run() -> Result<(), Box<dyn Error>> {
    heading();
    for problem in problems()?.iter().filter(|problem| problem.end == END) {
        match problem.tree {
            Tree::Paper => rows(&AbsoluteAngles(&Ideal::new()), problem, REPEATS)?,
            Tree::Rods => rows(&AbsoluteAngles(&Rods::new()), problem, REPEATS)?,
        }
    }
    Ok(())
}

fn rows<O: TaylorOde<f64>>(
    ode: &O,
    problem: &Problem,
    repeats: usize,
) -> Result<(), Box<dyn Error>> {
    let options = |tolerance| Options {
        compensated: true,
        ..Options::with_tolerance(tolerance)
    };
    let methods = [
        (
            "Taylor",
            points(ode, problem, repeats, |tolerance| {
                Taylor::new(options(tolerance))
            })?,
        ),
        (
            "Dop853",
            points(ode, problem, repeats, |tolerance| {
                Dop853::new(options(tolerance))
            })?,
        ),
        (
            "Verner98",
            points(ode, problem, repeats, |tolerance| {
                Verner98::new(options(tolerance))
            })?,
        ),
    ];
    for (method, points) in methods {
        print!("{:32}", format!("{}, {method}", problem.name));
        for error in ERRORS {
            match time_for(&points, error) {
                Some(micros) => print!("{micros:>9.0}"),
                None => print!("{:>9}", "-"),
            }
        }
        println!();
    }
    Ok(())
}
