//! Tables, CSV files and charts.

use branched_pendulum_advice::{MethodRun, WorkPrecision};
use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_data::{Cell, Column};

use super::measure::EnergyDrift;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Errors in the table.
const LEVELS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-14];

/// Name of a problem, and its runs.
pub type Runs = (&'static str, WorkPrecision);

/// Returns the table of times, with the shortest marked.
pub fn table(problems: &[Runs]) -> String {
    let mut text = String::from("Time in µs to an error at the end; * the shortest.\n");
    for (name, measured) in problems {
        text += &format!("\n{name}\n{}", measured.table(&LEVELS));
    }
    text
}

/// Returns the table of the energy's errors.
pub fn drift_table(drifts: &[EnergyDrift]) -> String {
    let mut text = String::from("\nRelative error of the energy in 1,000 s of regular motion\n\n");
    for drift in drifts {
        let worst = |part: &[f64]| part.iter().copied().fold(0.0_f64, f64::max);
        let (first, last) = (worst(&drift.errors[..1]), worst(&drift.errors[99..]));
        text += &format!(
            "{:40} {first:9.1e} in the first 10 s, {last:9.1e} in the last, {} evaluations\n",
            drift.name, drift.evaluations
        );
    }
    text
}

/// Writes the runs of all problems as a table and two charts.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write_runs(job: &Job, problems: &[Runs]) -> Result<(), Failure> {
    let columns = [
        Column::new("problem", ""),
        Column::new("method", ""),
        Column::new("tolerance or step", ""),
        Column::new("error", "rad or rad/s"),
        Column::new("time", "us"),
        Column::new("evaluations", ""),
    ];
    job.csv("work-precision.csv", &columns, |csv| {
        for (problem, runs) in problems {
            for run in runs.runs() {
                csv.row([
                    Cell::from(*problem),
                    run.method.title().into(),
                    run.setting.into(),
                    run.error.into(),
                    (run.seconds * 1e6).into(),
                    run.evaluations.into(),
                ])?;
            }
        }
        Ok(())
    })?;
    let against_time = "Error at the end against time, absolute angles";
    let time = chart(against_time, "time (µs)", problems, |run| {
        run.seconds * 1e6
    });
    job.chart("work-precision-time", &time)?;
    let against_work = "Error at the end against work, absolute angles";
    let axis = "evaluations (of Taylor: orders)";
    let work = chart(against_work, axis, problems, |run| run.evaluations as f64);
    job.chart("work-precision-evaluations", &work)
}

/// Writes the energy's errors as a table with a row for each method and part of the motion, and as
/// a chart.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write_drifts(job: &Job, drifts: &[EnergyDrift]) -> Result<(), Failure> {
    let columns = [
        Column::new("run", ""),
        Column::new("time", "s"),
        Column::new("relative error of the energy", ""),
    ];
    job.csv("energy-drift.csv", &columns, |csv| {
        for drift in drifts {
            for (&time, &error) in drift.times.iter().zip(&drift.errors) {
                csv.row([Cell::from(drift.name.as_str()), time.into(), error.into()])?;
            }
        }
        Ok(())
    })?;
    job.chart("energy-drift", &drift_chart(drifts))
}

fn chart(title: &str, x: &str, problems: &[Runs], cost: impl Fn(&MethodRun) -> f64) -> Chart {
    let rows = problems.len().div_ceil(2);
    let chart = Chart::new(title, Axis::log(x))
        .columns(2)
        .size(1100.0, 140.0 + 300.0 * rows as f64);
    problems.iter().fold(chart, |chart, (name, runs)| {
        let panel = Panel::new(Axis::log(format!("error, {name}")).range(1e-14, 10.0));
        let panel = runs.methods().into_iter().fold(panel, |panel, method| {
            let own = runs.runs_of(method);
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
