//! Linear modes about a stable equilibrium of a tree.

use std::fmt::Write;

use branched_pendulum::analysis::{Equilibrium, Stability};
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::release::RestArguments;
use crate::subject::{Subject, TreeArguments};

/// At which frequencies and in which shapes does a tree oscillate about its equilibrium? This is
/// the stable equilibrium to which it descends from `--start`. Friction and drive are neglected.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum modes", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    rest: RestArguments,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("modes-output");
}

/// Prints the frequencies and shapes of the modes, and writes them as a table.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let tree = &subject.tree;
    let rest = arguments.rest.rest(&subject)?;
    let modes = tree.modes(&rest.theta)?;
    let mut text = format!(
        "{}: frequencies (Hz) and shapes, whose largest angle is 1, about the rest\n\
         ({})\n\n{:>10}",
        subject.name,
        subject.angles_in_words(&rest.theta),
        "Hz"
    );
    let width = |name: &String| name.chars().count().max(7) + 2;
    for name in tree.names() {
        let width = width(name);
        // Writing to a string cannot fail.
        let _ = write!(text, "{name:>width$}");
    }
    text.push('\n');
    let rows: Vec<(f64, Vec<f64>)> = modes
        .frequencies_hz
        .iter()
        .zip(&modes.shapes)
        .map(|(frequency, shape)| {
            let largest = shape
                .iter()
                .fold(0.0_f64, |most, part| most.max(part.abs()));
            (
                *frequency,
                shape.iter().map(|part| part / largest).collect(),
            )
        })
        .collect();
    for (frequency, shape) in &rows {
        let _ = write!(text, "{frequency:10.5}");
        for (part, name) in shape.iter().zip(tree.names()) {
            let width = width(name);
            let _ = write!(text, "{:>width$}", format!("{part:.4}"));
        }
        text.push('\n');
    }
    text.push_str(&others(&subject, &rest));
    job.print(&text)?;
    job.report("rest (rad)", rest.theta);
    let mut columns = vec![Column::new("frequency", "Hz")];
    columns.extend(
        tree.names()
            .iter()
            .map(|name| Column::new(name.as_str(), "")),
    );
    job.csv("modes.csv", &columns, |csv| {
        rows.iter().try_for_each(|(frequency, shape)| {
            csv.row(
                std::iter::once(frequency)
                    .chain(shape)
                    .map(|value| Cell::from(*value)),
            )
        })
    })?;
    job.report("frequencies_hz", modes.frequencies_hz);
    Ok(())
}

/// Distance (rad) below which two equilibria count as the same.
const SAME: f64 = 1e-5;

/// Largest number of other equilibria that are listed.
const MOST_RESTS: usize = 6;

/// Lists the other stable equilibria, each as a command-line option that leads to it.
fn others(subject: &Subject, rest: &Equilibrium) -> String {
    let all = subject.tree.equilibria().unwrap_or_default();
    let is_other = |own: &&Equilibrium| {
        let mut both = own.theta.iter().zip(&rest.theta);
        own.stability != Stability::Unstable && both.any(|(a, b)| (a - b).abs() > SAME)
    };
    let mut text = String::new();
    for own in all.iter().filter(is_other).take(MOST_RESTS) {
        let degrees = own
            .theta
            .iter()
            .map(|angle| format!("{:.2}", angle.to_degrees() + 0.0));
        let degrees = degrees.collect::<Vec<_>>().join(",");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "another stable rest: --start {degrees}");
    }
    match text.is_empty() {
        true => text,
        false => format!("\n{text}"),
    }
}
