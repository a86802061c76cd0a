//! Growth thresholds of trees given by a rule, by the equations for small differences.
//!
//! - [`arguments`]: the command line,
//! - [`trees`]: the trees and their thresholds,
//! - [`chart`]: the chart.

pub mod arguments;
pub mod chart;
pub mod trees;

use std::fmt::Write;

use branched_pendulum_data::{Cell, Column};
use branched_pendulum_frame::{Failure, Job};

pub use arguments::Arguments;
use trees::{COPIES, GENERATIONS, LENGTHS, MASSES, PERIODS, Rule, Threshold, threshold};

/// Computes, prints and writes the thresholds of all trees.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let mut rules = Vec::new();
    for copies in COPIES {
        for mass_ratio in MASSES {
            for length_ratio in LENGTHS {
                rules.extend(GENERATIONS.iter().map(|&generations| Rule {
                    generations,
                    copies,
                    mass_ratio,
                    length_ratio,
                }));
            }
        }
    }
    let progress = job.progress(rules.len());
    progress.begin("trees");
    let mut thresholds = Vec::new();
    for rule in rules {
        if job.is_interrupted() {
            break;
        }
        thresholds.push(threshold(rule, arguments)?);
        job.take_interruption();
        progress.next();
    }
    if thresholds.is_empty() {
        return Ok(());
    }
    job.print(&report(arguments, &thresholds))?;
    // A run that was interrupted may not have come to all ratios, which are a panel each.
    let is_found = |length: &f64| {
        let mut found = thresholds.iter().filter(|t| t.angle_deg.is_some());
        found.any(|threshold| threshold.rule.length_ratio == *length)
    };
    if LENGTHS.iter().all(is_found) {
        let chart = chart::thresholds(arguments, &thresholds);
        job.chart("critical-angles", &chart)?;
    }
    let columns = [
        Column::new("copies", ""),
        Column::new("mass ratio", ""),
        Column::new("length ratio", ""),
        Column::new("generations", ""),
        Column::new("critical angle", "degrees"),
        Column::new("determined", ""),
        Column::new("growth at the first angle", ""),
    ];
    job.csv("critical-angles.csv", &columns, |csv| {
        thresholds.iter().try_for_each(|threshold| {
            let Rule {
                generations,
                copies,
                mass_ratio,
                length_ratio,
            } = threshold.rule;
            csv.row([
                Cell::from(u64::from(copies)),
                mass_ratio.into(),
                length_ratio.into(),
                (generations as u64).into(),
                threshold.angle_deg.unwrap_or(f64::NAN).into(),
                u64::from(threshold.determined).into(),
                threshold.first_factor.into(),
            ])
        })
    })
}

fn report(arguments: &Arguments, thresholds: &[Threshold]) -> String {
    let level = arguments.level;
    let mut text = format!(
        "Smallest angle of the root, all others vertical, from which differences of the first\n\
         branching grow {level}-fold within {PERIODS} periods of theirs at rest\n\n\
         copies  mass ratio  length ratio  generations:"
    );
    for generations in GENERATIONS {
        let _ = write!(text, "{generations:>9}");
    }
    for row in thresholds.chunks(GENERATIONS.len()) {
        let Some(Threshold { rule, .. }) = row.first() else {
            continue;
        };
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n{:6}  {:10}  {:12}              ",
            rule.copies, rule.mass_ratio, rule.length_ratio
        );
        for threshold in row {
            let mark = if threshold.determined { "" } else { "?" };
            let angle = threshold
                .angle_deg
                .map_or("-".to_owned(), |angle| format!("{angle}°{mark}"));
            let _ = write!(text, "{angle:>9}");
        }
    }
    let factors = || thresholds.iter().map(|threshold| threshold.first_factor);
    let _ = writeln!(
        text,
        "\n(- nowhere in the scan, ? not determined)\n\n\
         At the first angle, {}°, they grow {:.3}- to {:.3}-fold.",
        arguments.angles_deg.first().copied().unwrap_or(f64::NAN),
        factors().fold(f64::INFINITY, f64::min),
        factors().fold(f64::NEG_INFINITY, f64::max),
    );
    text
}
