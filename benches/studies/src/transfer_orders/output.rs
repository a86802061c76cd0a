//! The tables, the CSV files and the charts.

use branched_pendulum::analysis::truncation::ErrorCurve;
use branched_pendulum_charts::{Axis, Chart, Panel, Series};
use branched_pendulum_data::{Cell, Column};

use super::study::{AMPLITUDES, Study};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Levels of the relative error in the table.
const LEVELS: [(&str, f64); 3] = [("1 %", 0.01), ("10 %", 0.1), ("100 %", 1.0)];

/// Range of the relative error in the charts: below, nobody asks.
const ERRORS: [f64; 2] = [1e-10, 1e1];

/// The table of one tree.
pub fn table(study: &Study) -> String {
    let Study {
        settings,
        phase_average,
        trajectories,
        costs,
    } = study;
    let along = &settings.trajectories;
    let samples: u64 = trajectories.first().map_or(0, |curve| {
        curve.points.iter().map(|point| point.states).sum()
    });
    let [low, high] = AMPLITUDES;
    let mut text = format!(
        "W in {}.\n\
         Relative error: rms of (W − W exact) over rms of W exact.\n\
         Phase average: {} random states at each amplitude.\n\
         Trajectories: {} disturbances from {} to {} rad, {} s each;\n\
         {samples} samples have an amplitude from {low} to {high} rad.\n",
        settings.title,
        settings.phase_average.states,
        along.disturbances.len(),
        along.disturbances.first().unwrap_or(&f64::NAN),
        along.disturbances.last().unwrap_or(&f64::NAN),
        along.duration,
    );
    for (average, along) in phase_average.iter().zip(trajectories) {
        text += &format!(
            "\nAmplitude, rad, at which the error of W into `{}` passes\n\n\
                 {:20}  {:^23}   {:>20}\n{:20}",
            average.receiver, "", "phase average", "along trajectories", "form",
        );
        for gap in ["", " "] {
            text.push_str(gap);
            for (level, _) in LEVELS {
                text += &format!(" {level:>7}");
            }
            text.push(' ');
        }
        text.push_str("    cost\n");
        for (form, (name, ratio)) in average.forms.iter().zip(&costs.ratios).enumerate() {
            text += &format!("{:20}", name.to_string());
            for (gap, curve) in [("", average), (" ", along)] {
                text.push_str(gap);
                for (_, level) in LEVELS {
                    let crossing = curve.crossing(form, level);
                    let crossing = crossing.map_or("-".to_owned(), |crossing| crossing.to_string());
                    text += &format!(" {crossing:>7}");
                }
                text.push(' ');
            }
            text += &format!(" {ratio:7.2}\n");
        }
    }
    text += &format!(
        "\nCost: time for one evaluation from (q, p) of W into all sectors, in that of the\n\
             exact form, {:.0} ns here (median, one state after the other).\n\n",
        costs.exact_ns
    );
    text
}

/// Prints the table of one tree and writes its curves and its chart.
///
/// # Errors
/// [`Failure`].
pub fn deliver(job: &Job, study: &Study) -> Result<(), Failure> {
    write(job, study)?;
    job.print(&table(study))
}

/// Writes the curves of one tree as CSV, one file for each sector and average,
/// and the chart.
///
/// # Errors
/// [`Failure::Csv`], [`Failure::Chart`] or [`Failure::File`].
pub fn write(job: &Job, study: &Study) -> Result<(), Failure> {
    let name = study.settings.name;
    for (kind, curves) in [
        ("phase-average", &study.phase_average),
        ("trajectories", &study.trajectories),
    ] {
        for curve in curves {
            let file = format!("{name}-{}-{kind}.csv", curve.receiver);
            write_csv(job, &file, curve)?;
        }
    }
    job.chart(&format!("transfer-orders-{name}"), &chart(study))
}

fn write_csv(job: &Job, name: &str, curve: &ErrorCurve) -> Result<(), Failure> {
    let mut columns = vec![Column::new("amplitude", "rad"), Column::new("states", "")];
    let names = curve.forms.iter();
    columns.extend(names.map(|form| Column::new(format!("relative error {form}"), "")));
    job.csv(name, &columns, |file| {
        curve.points.iter().try_for_each(|point| {
            let mut row = vec![Cell::from(point.amplitude), Cell::from(point.states)];
            row.extend(point.errors.iter().map(Cell::from));
            file.row(row)
        })
    })
}

fn chart(study: &Study) -> Chart {
    let panel = |name: &str, curve: &ErrorCurve| {
        let [low, high] = ERRORS;
        // An underscore would lower what follows it.
        let receiver = curve.receiver.replace('_', " ");
        let axis = Axis::log(format!("{name}, into {receiver}")).range(low, high);
        let amplitudes: Vec<f64> = curve.points.iter().map(|point| point.amplitude).collect();
        let forms = curve.forms.iter().zip(&study.costs.ratios).enumerate();
        forms.fold(Panel::new(axis), |panel, (form, (name, cost))| {
            // What it costs stands beside what it is worth.
            let label = format!("{name}, cost {cost:.1}");
            panel.series(Series::line(label, &amplitudes, &curve.errors(form)))
        })
    };
    let [low, high] = AMPLITUDES;
    let axis = Axis::log("amplitude of the differences (rad)").range(low, high);
    let title = format!(
        "Relative error of W (rms over rms): {}",
        study.settings.title
    );
    let panels = 2 * study.phase_average.len();
    let mut chart = Chart::new(title, axis).size(900.0, 120.0 + 290.0 * panels as f64);
    for (average, along) in study.phase_average.iter().zip(&study.trajectories) {
        for (name, curve) in [("phase average", average), ("trajectories", along)] {
            // A sector may take part in no motion.
            if !curve.points.is_empty() {
                chart = chart.panel(panel(name, curve));
            }
        }
    }
    chart
}
