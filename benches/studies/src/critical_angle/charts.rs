//! Growth factors against the angle of release, and thresholds of trees.

use branched_pendulum_charts::{Axis, Chart, Dash, Panel, Series};

use super::arguments::Arguments;
use super::scan::{Friction, PAPER, Scan};
use super::trees::{COPIES, LENGTHS, MASSES, Threshold};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Growth factors that the charts show. Lines lead out of them where there is more, and
/// beyond the largest number too.
const SHOWN: [f64; 2] = [0.8, 1e6];

/// Angles about the threshold of the paper, degrees.
const NEAR: [f64; 2] = [40.0, 50.0];

/// Writes the chart of all angles, and one of those near the paper's where there are any.
///
/// # Errors
/// [`Failure::Chart`] or [`Failure::File`].
pub fn write(job: &Job, arguments: &Arguments, scans: &[Scan]) -> Result<(), Failure> {
    let (Some(&first), Some(&last)) = (arguments.angles_deg.first(), arguments.angles_deg.last())
    else {
        return Ok(());
    };
    if scans.is_empty() || first == last {
        return Ok(());
    }
    job.chart("growth-factor", &chart(arguments, scans, [first, last]))?;
    let near = [first.max(NEAR[0]), last.min(NEAR[1])];
    if near[0] < near[1] && near != [first, last] {
        job.chart("growth-factor-near", &chart(arguments, scans, near))?;
    }
    Ok(())
}

fn chart(arguments: &Arguments, scans: &[Scan], [first, last]: [f64; 2]) -> Chart {
    let x = Axis::linear("θ_1(0) (°)").range(first, last);
    let title = "Growth of a small antiphase difference, released with vertical children";
    let height = 90.0 + 210.0 * arguments.horizons.len() as f64;
    let chart = Chart::new(title, x).size(900.0, height);
    let horizons = arguments.horizons.iter().enumerate();
    horizons.fold(chart, |chart, (number, horizon)| {
        let [low, high] = SHOWN;
        let axis = Axis::log(format!("G({horizon} s)")).range(low, high);
        let panel = scans.iter().fold(Panel::new(axis), |panel, scan| {
            let points = scan
                .points()
                .filter(|(angle, _)| (first..=last).contains(angle));
            let (x, y): (Vec<f64>, Vec<f64>) = points
                .map(|(angle, grown)| (angle, grown.factors[number].value.min(1e99)))
                .unzip();
            if x.is_empty() {
                return panel;
            }
            panel.series(Series::line(label(scan.friction), &x, &y).dash(Dash::Solid))
        });
        let marked = PAPER.iter().filter(|_| number == 0);
        let panel = marked.fold(panel, |panel, angle| {
            panel.vertical(*angle, format!("{angle}°"))
        });
        let unmarked = PAPER.iter().filter(|_| number > 0);
        chart.panel(unmarked.fold(panel, |panel, angle| panel.vertical(*angle, "")))
    })
}

/// Draws the thresholds of trees against their generations, a panel for each ratio of lengths.
pub fn thresholds(arguments: &Arguments, thresholds: &[Threshold]) -> Chart {
    let level = arguments.levels.first().copied().unwrap_or(f64::NAN);
    let title = format!("From where differences of the first branching grow {level}-fold");
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

fn label(friction: Friction) -> String {
    match friction {
        Friction::Without => "no friction".to_owned(),
        Friction::Quality(quality) => format!("Q = {quality}"),
    }
}
