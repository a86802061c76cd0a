//! Table, frames and chart.

use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_data::{Cell, Column};

use super::arguments::Arguments;
use super::motion::{Branches, Seen, Trial};
use super::scene::{Branch, LINKS};
use super::storm::Storm;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Writes the angles of all frames.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write_frames(job: &Job, seen: &Seen) -> Result<(), Failure> {
    let mut columns = vec![Column::new("time", "s")];
    let names = Branch::LINK_NAMES.iter();
    columns.extend(names.map(|name| Column::new(*name, "rad")));
    job.csv("swaying-branch.csv", &columns, |file| {
        for (number, state) in seen.states.iter().enumerate() {
            let mut row = vec![number as f64 * seen.frame];
            row.extend(&state[..LINKS]);
            file.row(&row)?;
        }
        Ok(())
    })
}

/// Writes errors and costs of all models, as a table and as a chart.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write_trials(job: &Job, trials: &[Trial]) -> Result<(), Failure> {
    let columns = [
        Column::new("share of the wind", ""),
        Column::new("model", ""),
        Column::new("setting", ""),
        Column::new("error", "rad"),
        Column::new("time of a frame", "us"),
    ];
    job.csv("swaying-branch-models.csv", &columns, |file| {
        for trial in trials {
            for model in &trial.models {
                file.row([
                    Cell::from(trial.share),
                    model.kind.as_str().into(),
                    model.setting.as_str().into(),
                    model.error.into(),
                    model.microseconds.into(),
                ])?;
            }
        }
        Ok(())
    })?;
    job.chart("swaying-branch-models", &chart(trials))
}

/// Returns the chart of cost against error, with a panel for each wind.
fn chart(trials: &[Trial]) -> Chart {
    let title = "Branch of 31 links: cost of a frame against error";
    let chart = Chart::new(title, Axis::log("time of a frame (µs)"));
    let chart = chart.size(900.0, 140.0 + 260.0 * trials.len() as f64);
    trials.iter().fold(chart, |chart, trial| {
        let label = format!("error (rad), {} × wind", trial.share);
        let mut panel = Panel::new(Axis::log(label).range(1e-8, 10.0));
        let mut kinds: Vec<&str> = Vec::new();
        for model in &trial.models {
            if !kinds.contains(&model.kind.as_str()) {
                kinds.push(&model.kind);
            }
        }
        for kind in kinds {
            let own = trial.models.iter().filter(|model| model.kind == kind);
            let (x, y): (Vec<f64>, Vec<f64>) =
                own.map(|model| (model.microseconds, model.error)).unzip();
            panel = panel.series(Series::line(kind, &x, &y).with_symbols());
        }
        chart.panel(panel)
    })
}

/// Everything that is printed.
pub fn text(arguments: &Arguments, branches: &Branches, trials: &[Trial], storm: &Storm) -> String {
    let frequencies = branches.linear.frequencies_hz();
    let (slowest, fastest) = (
        frequencies.first().copied().unwrap_or_default(),
        frequencies.last().copied().unwrap_or_default(),
    );
    let mut text = format!(
        "A branch of {LINKS} links with modes from {slowest:.2} to {fastest:.1} Hz, in wind of \
         {} m/s;\na hand pulls it with {} N and lets go. Frames of 1/{} s, sub-steps of at most \
         {:.2} ms.\n",
        arguments.wind,
        arguments.pull,
        arguments.frame_rate,
        1e3 * branches.sub_step
    );
    for trial in trials {
        text += &format!(
            "\n{} of wind and pull, angles up to {:.2} rad from rest\n\n\
                 | model | setting | error (rad) | a frame (µs) | a sub-step (µs) |\n\
                 |---|---|---:|---:|---:|\n",
            trial.share, trial.amplitude
        );
        for model in &trial.models {
            let sub_step = match model.sub_steps {
                0 => String::new(),
                count => format!("{:.3}", model.microseconds / f64::from(count)),
            };
            text += &format!(
                "| {} | {} | {:.1e} | {:.3} | {sub_step} |\n",
                model.kind, model.setting, model.error, model.microseconds
            );
        }
    }
    text += &format!(
        "\nStorm: {} frames with {} hits of a million newtons, {} states not finite, {} \
             sub-steps with\nlimited rates, none above {:.0} rad/s.\n",
        storm.frames, storm.hits, storm.not_finite, storm.limited, storm.largest_rate
    );
    text
}
