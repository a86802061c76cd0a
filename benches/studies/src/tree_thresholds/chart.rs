//! Thresholds against generations.

use branched_pendulum_charts::{Axis, Chart, Panel, Series};

use super::arguments::Arguments;
use super::trees::{COPIES, LENGTHS, MASSES, Threshold};

/// Draws the thresholds of trees against their number of generations, with a panel for each ratio
/// of lengths.
pub fn thresholds(arguments: &Arguments, thresholds: &[Threshold]) -> Chart {
    let title = format!(
        "From where differences of the first branching grow {}-fold",
        arguments.level
    );
    let chart = Chart::new(title, Axis::linear("generations").range(1.8, 6.2));
    let chart = chart.columns(LENGTHS.len()).size(1100.0, 480.0);
    LENGTHS.iter().fold(chart, |chart, &length| {
        let axis = format!("θ of the root (°), lengths by {length}");
        let rules = COPIES.iter().flat_map(|k| MASSES.map(|mass| (*k, mass)));
        chart.panel(rules.fold(
            Panel::new(Axis::linear(axis).range(0.0, 90.0)),
            |panel, (copies, mass)| {
                let own = thresholds.iter().filter(|threshold| {
                    let rule = threshold.rule;
                    (rule.copies, rule.mass_ratio, rule.length_ratio) == (copies, mass, length)
                });
                let points = own.filter_map(|threshold| {
                    Some((threshold.rule.generations as f64, threshold.angle_deg?))
                });
                let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
                if x.is_empty() {
                    return panel;
                }
                let label = format!("{copies} copies, masses by {mass}");
                panel.series(Series::line(label, &x, &y).with_symbols())
            },
        ))
    })
}
