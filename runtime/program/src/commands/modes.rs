//! Linear modes about the place where a tree rests.

use std::fmt::Write;

use branched_pendulum::system::Model;
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::subject::TreeArguments;

/// At which frequencies and in which shapes does a tree swing a little about its rest?
/// Friction and drive are left out.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum modes", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("modes-output");
}

/// Prints frequencies and shapes and writes them as a table.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job);
    let tree = &subject.tree;
    let rest = tree.equilibrium(&vec![0.0; tree.links()])?;
    let modes = tree.modes(&rest)?;
    let mut text = format!(
        "{}: frequencies (Hz) and shapes, whose largest angle is 1\n\n{:>10}",
        subject.name, "Hz"
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
    job.print(&text)?;
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
