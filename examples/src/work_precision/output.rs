//! Tables, CSV files and charts.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use branched_pendulum::data::{Column, CsvWriter};
use branched_pendulum_charts::{Axis, Chart, Panel, Series};

use super::measure::{EnergyDrift, METHODS, Measurement, time_to_error};
use crate::branched_double::Failure;
use crate::solvers::legend;

/// Errors in the table.
const LEVELS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-14];

/// A problem's name and its runs.
pub type Runs = (&'static str, Vec<Measurement>);

/// The table that the program prints: times, the shortest marked.
pub fn table(problems: &[Runs], drifts: &[EnergyDrift]) -> String {
    let mut text = String::from("Time in µs to an error at the end; * the shortest.\n");
    for (name, runs) in problems {
        push(&mut text, format_args!("\n{name:24}"));
        for level in LEVELS {
            push(&mut text, format_args!("{level:>10e} "));
        }
        text.push('\n');
        let times = METHODS.map(|method| LEVELS.map(|level| time_to_error(runs, method, level)));
        for (method, row) in METHODS.iter().zip(&times) {
            push(&mut text, format_args!("{:24}", method.title()));
            for (column, time) in row.iter().enumerate() {
                let others = times.iter().filter_map(|row| row[column]);
                let best = others.fold(f64::INFINITY, f64::min);
                let _ = match time {
                    Some(time) => {
                        write!(text, "{time:10.0}{}", if *time == best { '*' } else { ' ' })
                    }
                    None => write!(text, "{:>10} ", "-"),
                };
            }
            text.push('\n');
        }
    }
    text.push_str("\nRelative error of the energy in 1,000 s of regular motion\n\n");
    for drift in drifts {
        let worst = |part: &[f64]| part.iter().copied().fold(0.0_f64, f64::max);
        let (first, last) = (worst(&drift.errors[..1]), worst(&drift.errors[99..]));
        push(
            &mut text,
            format_args!(
                "{:40} {first:9.1e} in the first 10 s, {last:9.1e} in the last, {} evaluations\n",
                drift.name, drift.evaluations
            ),
        );
    }
    text
}

fn push(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = text.write_fmt(arguments);
}

/// Writes CSV files and charts, and returns the files.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::Chart`].
pub fn write(
    folder: &Path,
    problems: &[Runs],
    drifts: &[EnergyDrift],
) -> Result<Vec<PathBuf>, Failure> {
    let mut files = vec![
        folder.join("work-precision.csv"),
        folder.join("energy-drift.csv"),
    ];
    let numbered = problems.iter().enumerate();
    let names: Vec<_> = numbered
        .map(|(index, (name, _))| format!("{index} {}", name.replace(',', "")))
        .collect();
    let mut csv = CsvWriter::create(
        &files[0],
        &[
            Column::new(format!("problem: {}", names.join("; ")), ""),
            Column::new(legend(&METHODS), ""),
            Column::new("tolerance or step", ""),
            Column::new("error", "rad or rad/s"),
            Column::new("time", "us"),
            Column::new("evaluations", ""),
        ],
    )?;
    for (problem, (_, runs)) in problems.iter().enumerate() {
        for run in runs {
            let method = METHODS.iter().position(|method| *method == run.method);
            csv.row(&[
                problem as f64,
                method.unwrap_or(METHODS.len()) as f64,
                run.setting,
                run.error,
                run.microseconds,
                run.evaluations as f64,
            ])?;
        }
    }
    csv.finish()?;
    let mut columns = vec![Column::new("time", "s")];
    columns.extend(
        drifts
            .iter()
            .map(|drift| Column::new(drift.name.replace(',', ""), "")),
    );
    let mut csv = CsvWriter::create(&files[1], &columns)?;
    for row in 0..drifts.first().map_or(0, |drift| drift.times.len()) {
        let mut values = vec![drifts[0].times[row]];
        values.extend(drifts.iter().map(|drift| drift.errors[row]));
        csv.row(&values)?;
    }
    csv.finish()?;
    let against_time = "Error at the end against time, absolute angles";
    let against_work = "Error at the end against work, absolute angles";
    let charts = [
        (
            "work-precision-time",
            chart(against_time, "time (µs)", problems, |run| run.microseconds),
        ),
        (
            "work-precision-evaluations",
            chart(
                against_work,
                "evaluations (of Taylor: orders)",
                problems,
                |run| run.evaluations as f64,
            ),
        ),
        ("energy-drift", drift_chart(drifts)),
    ];
    for (name, chart) in charts {
        let (svg, png) = (
            folder.join(format!("{name}.svg")),
            folder.join(format!("{name}.png")),
        );
        chart.write_svg(&svg)?;
        chart.write_png(&png)?;
        files.extend([svg, png]);
    }
    Ok(files)
}

fn chart(title: &str, x: &str, problems: &[Runs], cost: impl Fn(&Measurement) -> f64) -> Chart {
    let chart = Chart::new(title, Axis::log(x)).size(900.0, 120.0 + 320.0 * problems.len() as f64);
    problems.iter().fold(chart, |chart, (name, runs)| {
        let panel = Panel::new(Axis::log(format!("error, {name}")).range(1e-14, 10.0));
        let panel = METHODS.iter().fold(panel, |panel, method| {
            let own = runs.iter().filter(|run| run.method == *method);
            let (x, y): (Vec<f64>, Vec<f64>) = own.map(|run| (cost(run), run.error)).unzip();
            panel.series(Series::line(method.title(), &x, &y).with_symbols())
        });
        chart.panel(panel)
    })
}

fn drift_chart(drifts: &[EnergyDrift]) -> Chart {
    let panel = Panel::new(Axis::log("relative error of the energy").range(1e-16, 1e-2));
    let panel = drifts.iter().fold(panel, |panel, drift| {
        panel.line(&drift.name, &drift.times, &drift.errors)
    });
    let title = "Energy over 1,000 s of regular motion, absolute angles";
    Chart::new(title, Axis::linear("t (s)")).panel(panel)
}
