//! Energy transfer into the differences between copies: orders against the exact form.

use std::fmt::Write;

use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::Given;
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_charts::{Axis, Chart, Panel};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::TreeError;
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::frame::command_line::number;
use crate::motion::{MethodArguments, sample};
use crate::release::ReleaseArguments;
use crate::subject::TreeArguments;

/// How good are the orders of W? Computes the transfer of energy into the differences
/// between copies along a motion: exact, as published (first order of the angles of the
/// differences) and by orders of their amplitude, and compares them.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum transfer", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    method: MethodArguments,
    /// time followed, s from 0.01 to 1e5
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.01..=1e5, "s"))]
    duration: f64,
    /// samples in a second, 1 to 1e4
    #[arg(long, value_name = "HZ", default_value = "100", value_parser = number(1.0..=1e4, "Hz"))]
    rate: f64,
    /// sector that receives; the first difference, unless it is named
    #[arg(long, value_name = "SECTOR")]
    into: Option<String>,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("transfer-output");
}

const FORMS: [(TransferForm, &str); 6] = [
    (TransferForm::Exact, "exact"),
    (TransferForm::Angle(1), "published"),
    (TransferForm::Amplitude(2), "order 2"),
    (TransferForm::Amplitude(4), "order 4"),
    (TransferForm::Amplitude(6), "order 6"),
    (TransferForm::Amplitude(8), "order 8"),
];

/// Computes W by all forms and writes what was found.
///
/// # Errors
/// [`Failure`]; [`Failure::Tree`] for a tree without copies.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    let refused = |source: TreeError| Failure::Tree {
        name: subject.name.clone(),
        source,
    };
    let symmetric = subject.tree.symmetric().map_err(refused)?;
    let names: Vec<&str> = symmetric
        .sectors()
        .iter()
        .map(|sector| sector.name())
        .collect();
    let into = match &arguments.into {
        None => 1,
        Some(name) => symmetric.sector(name).ok_or_else(|| Failure::Lacking {
            what: format!(
                "there is no sector `{name}`: the tree has {}",
                names.join(", ")
            ),
        })?,
    };
    let start = arguments.release.state(&subject)?;
    let count = (arguments.duration * arguments.rate).round().max(1.0);
    let times = (0..=count as usize).map(|k| k as f64 * arguments.duration / count);
    let samples = sample(&subject, &arguments.method, &start, times.collect())?;
    let mut workspace = Workspace::new();
    let mut transfers = vec![Transfer::default(); names.len()];
    let mut rows: Vec<[Transfer<f64>; FORMS.len()]> = Vec::with_capacity(samples.times.len());
    for state in &samples.states {
        let (theta, omega) = state.split_at(symmetric.links());
        let mut row = [Transfer::default(); FORMS.len()];
        for ((form, _), own) in FORMS.iter().zip(&mut row) {
            let given = Given::Absolute { theta, omega };
            symmetric.transfers(&mut workspace, *form, given, &mut transfers);
            *own = transfers.get(into).copied().unwrap_or_default();
        }
        rows.push(row);
    }
    let column = |form: usize| {
        rows.iter()
            .map(|row| row[form].total())
            .collect::<Vec<f64>>()
    };
    let largest = column(0).iter().fold(0.0_f64, |most, w| most.max(w.abs()));
    let mut text = format!(
        "{}: W into {} over {} s, at most {largest:.4e} W\n\n{:12}{:>24}{:>24}\n",
        subject.name,
        names[into],
        arguments.duration,
        "form",
        "largest error (W)",
        "part of the largest W"
    );
    for (number, (_, name)) in FORMS.iter().enumerate().skip(1) {
        let errors = column(number)
            .into_iter()
            .zip(column(0))
            .map(|(w, exact)| (w - exact).abs());
        let worst = errors.fold(0.0, f64::max);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:12}{worst:24.4e}{:24.4e}", worst / largest);
    }
    job.print(&text)?;
    let mut columns = vec![Column::new("time", "s")];
    for (_, name) in FORMS {
        columns.push(Column::new(format!("W_K {name}"), "W"));
        columns.push(Column::new(format!("W_P {name}"), "W"));
    }
    job.csv("transfer.csv", &columns, |csv| {
        for (time, row) in samples.times.iter().zip(&rows) {
            let parts = row.iter().flat_map(|w| [w.kinetic, w.potential]);
            csv.row(std::iter::once(*time).chain(parts).map(Cell::from))?;
        }
        Ok(())
    })?;
    let times = &samples.times;
    let exact = FORMS.iter().enumerate().take(3);
    let panel = exact.fold(
        Panel::new(Axis::linear("W (W)")).zero_line(),
        |panel, (number, (_, name))| panel.line(*name, times, &column(number)),
    );
    let errors = FORMS.iter().enumerate().skip(1).fold(
        Panel::new(Axis::log("|W − exact| (W)").range(1e-8 * largest, 10.0 * largest)),
        |panel, (number, (_, name))| {
            let both = column(number).into_iter().zip(column(0));
            let errors: Vec<f64> = both
                .map(|(w, exact)| (w - exact).abs().max(1e-99))
                .collect();
            panel.line(*name, times, &errors)
        },
    );
    let x = Axis::linear("time (s)").range(0.0, arguments.duration);
    let title = format!("{}: W into {}", subject.name, names[into]);
    job.chart(
        "transfer",
        &Chart::new(title, x)
            .panel(panel)
            .panel(errors)
            .size(900.0, 640.0),
    )
}
