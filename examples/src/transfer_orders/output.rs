//! The table, the CSV files and the chart.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use branched_pendulum::chart::{Axis, Chart, Panel, Series};
use branched_pendulum::data::{Column, CsvWriter};

use super::cost::Costs;
use super::error_curve::{AMPLITUDES, Crossing, Point};
use super::forms::FORMS;
use super::trajectories::{ANGLE_DEG, DISTURBANCES, DURATION, RELEASES};
use crate::branched_double::Failure;

/// Levels of the relative error in the table.
const LEVELS: [(&str, f64); 3] = [("1 %", 0.01), ("10 %", 0.1), ("100 %", 1.0)];

/// Range of the relative error in the chart: below, nobody asks.
const ERRORS: [f64; 2] = [1e-10, 1e1];

/// The two curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// Over states with random phases.
    pub phase_average: Vec<Point>,
    /// Along exact motions.
    pub trajectories: Vec<Point>,
    /// Over states of the nested tree with random phases.
    pub nested: Vec<Point>,
}

/// The table that the program prints.
pub fn table(curves: &Curves, costs: &Costs) -> String {
    let Curves {
        phase_average,
        trajectories,
        nested: _,
    } = curves;
    let states = phase_average.first().map_or(0, |point| point.states);
    let samples: u64 = trajectories.iter().map(|point| point.states).sum();
    let [low, high] = AMPLITUDES;
    let [least, most] = DISTURBANCES;
    let mut text = format!(
        "Relative error of W: rms of (W − W exact) over rms of W exact.\n\
         Phase average: {states} random states at each amplitude.\n\
         Trajectories: {RELEASES} releases from θ_1(0) = {ANGLE_DEG}° with θ_d(0) from {least} to \
         {most} rad,\n{DURATION} s each; {samples} samples have an amplitude from {low} to {high} rad.\n\n\
         Amplitude of the antiphase motion, rad, at which the error passes\n\n\
         {:20}  {:^23}   {:>20}\n{:20}",
        "", "phase average", "along trajectories", "form",
    );
    for gap in ["", " "] {
        text.push_str(gap);
        for (level, _) in LEVELS {
            push(&mut text, format_args!(" {level:>7}"));
        }
        text.push(' ');
    }
    text.push_str("    cost\n");
    for ((form, name), ratio) in FORMS.iter().enumerate().zip(costs.ratios) {
        push(&mut text, format_args!("{name:20}"));
        for (gap, curve) in [("", phase_average), (" ", trajectories)] {
            text.push_str(gap);
            for (_, level) in LEVELS {
                let crossing = Crossing::of(curve, form, level);
                let crossing = crossing.map_or("-".to_owned(), |crossing| crossing.to_string());
                push(&mut text, format_args!(" {crossing:>7}"));
            }
            text.push(' ');
        }
        push(&mut text, format_args!(" {ratio:7.2}\n"));
    }
    push(
        &mut text,
        format_args!(
            "\nCost: time for one evaluation from (q, p), in that of the exact form, {:.0} ns\n\
             here (median, one state after the other).\n",
            costs.exact_ns
        ),
    );
    text
}

/// The table for the nested tree.
pub fn nested_table(curve: &[Point], costs: &Costs) -> String {
    let mut text = String::from(
        "\nTwo arms with a hand each on a body: W into their antiphase sector, of two\n\
         coordinates. Amplitude, rad, at which the error passes, phase average.\n\n",
    );
    push(&mut text, format_args!("{:20}", "form"));
    for (level, _) in LEVELS {
        push(&mut text, format_args!(" {level:>7}"));
    }
    text.push_str("     cost\n");
    for ((form, name), ratio) in FORMS.iter().enumerate().zip(costs.ratios) {
        push(&mut text, format_args!("{name:20}"));
        for (_, level) in LEVELS {
            let crossing = Crossing::of(curve, form, level);
            let crossing = crossing.map_or("-".to_owned(), |crossing| crossing.to_string());
            push(&mut text, format_args!(" {crossing:>7}"));
        }
        push(&mut text, format_args!("  {ratio:7.2}\n"));
    }
    text
}

fn push(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = text.write_fmt(arguments);
}

/// Writes both curves as CSV and the chart as SVG and PNG, and returns the
/// files.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::Chart`].
pub fn write(folder: &Path, curves: &Curves) -> Result<Vec<PathBuf>, Failure> {
    let file = |name: &str| folder.join(name);
    let (svg, png) = (file("transfer-orders.svg"), file("transfer-orders.png"));
    let phase_average = file("phase-average.csv");
    let trajectories = file("trajectories.csv");
    let nested = file("nested-phase-average.csv");
    write_csv(&phase_average, &curves.phase_average)?;
    write_csv(&trajectories, &curves.trajectories)?;
    write_csv(&nested, &curves.nested)?;
    let chart = chart(curves);
    chart.write_svg(&svg)?;
    chart.write_png(&png)?;
    Ok(vec![phase_average, trajectories, nested, svg, png])
}

fn write_csv(path: &Path, curve: &[Point]) -> Result<(), Failure> {
    let mut columns = vec![Column::new("amplitude", "rad"), Column::new("states", "")];
    columns.extend(FORMS.map(|name| Column::new(format!("relative error {name}"), "")));
    let mut file = CsvWriter::create(path, &columns)?;
    for point in curve {
        let mut row = vec![point.amplitude, point.states as f64];
        row.extend(point.errors);
        file.row(&row)?;
    }
    file.finish()?;
    Ok(())
}

fn chart(curves: &Curves) -> Chart {
    let panel = |name: &str, curve: &[Point]| {
        let [low, high] = ERRORS;
        let axis = Axis::log(format!("relative error, {name}")).range(low, high);
        let amplitudes: Vec<f64> = curve.iter().map(|point| point.amplitude).collect();
        FORMS
            .iter()
            .enumerate()
            .fold(Panel::new(axis), |panel, (form, name)| {
                let errors: Vec<f64> = curve
                    .iter()
                    .map(|point| point.errors.get(form).copied().unwrap_or(f64::NAN))
                    .collect();
                panel.series(Series::line(*name, &amplitudes, &errors))
            })
    };
    let [low, high] = AMPLITUDES;
    let axis = Axis::log("amplitude of the antiphase motion (rad)").range(low, high);
    Chart::new("Error of W relative to the exact W (rms over rms)", axis)
        .size(900.0, 1240.0)
        .panel(panel("phase average", &curves.phase_average))
        .panel(panel("along trajectories", &curves.trajectories))
        .panel(panel("nested tree", &curves.nested))
}
