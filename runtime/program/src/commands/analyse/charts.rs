//! Charts of angle, energy and power against time, with their errors.

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, verbatim};
use branched_pendulum_measure::Bands;

use super::camera::Truth;
use super::estimate::{Estimate, quantity};
use super::source::Source;
use super::subject::{MeasuredTree, Names};

const BLUE: Color = Color::of_series(0);
const BLACK: Color = Color::rgb(0, 0, 0);

/// Largest number of measured points that are drawn on the estimate; more would hide it.
const MOST_POINTS: usize = 150;

/// Half width of the interval that contains 95 % of a normal distribution, in standard deviations.
const NORMAL_95: f64 = 1.96;

/// Draws the estimate; the true values of a simulated camera are dashed.
pub fn chart(subject: &MeasuredTree, source: &Source, estimate: &Estimate) -> Chart {
    let names = subject.names();
    let times = &source.times;
    let drawn = names.drawn;
    let angles: Vec<f64> = estimate.motion.iter().map(|[q, _]| q[drawn]).collect();
    let data: Vec<f64> = source
        .angles
        .iter()
        .map(|angles| {
            let links = angles.iter().map(|angle| angle.unwrap_or(f64::NAN));
            subject.coordinates(&links.collect::<Vec<_>>())[drawn]
        })
        .collect();
    let symbol = &names.symbols[drawn];
    let (some_times, some_data) = thinned(times, &data);
    let angle = Panel::new(Axis::linear(format!("{symbol} (rad)")))
        .series(
            Series::line("estimated", times, &angles)
                .color(BLUE)
                .dash(Dash::Solid),
        )
        .series(
            Series::points("measured", &some_times, &some_data)
                .color(BLACK)
                .small(),
        )
        .zero_line();
    let residuals = data
        .iter()
        .zip(&angles)
        .map(|(seen, estimated)| seen - estimated);
    let residuals: Vec<f64> = residuals.collect();
    let residuals = Panel::new(Axis::linear(format!(
        "{symbol}: measured − estimated (rad)"
    )))
    .series(
        Series::points("measured", times, &residuals)
            .color(BLACK)
            .small(),
    )
    .zero_line();
    let Names { energy, power, .. } = names;
    let truth = |of: fn(&Truth) -> f64| source.truth.iter().map(of).collect::<Vec<f64>>();
    let panel = |axis: String, index: usize, truth: Vec<f64>| {
        let axis = Axis::linear(axis);
        with_band(axis, times, &estimate.energies, index, &truth)
    };
    Chart::new(
        format!("{} from measured angles", verbatim(&names.energy_words)),
        Axis::linear("t (s)"),
    )
    .size(900.0, 960.0)
    .panel(angle)
    .panel(residuals)
    .panel(panel(
        format!("{energy} (J)"),
        quantity::ENERGY,
        truth(|truth| truth.energy),
    ))
    .panel(
        panel(
            format!("{power} (W)"),
            quantity::POWER,
            truth(|truth| truth.power),
        )
        .zero_line(),
    )
    .panel(panel("closure (J)".to_owned(), quantity::CLOSURE, Vec::new()).zero_line())
}

/// Returns every n-th measured point, so that not too many are drawn.
fn thinned(times: &[f64], data: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let points = times.iter().zip(data).filter(|(_, datum)| !datum.is_nan());
    let stride = points.clone().count().div_ceil(MOST_POINTS).max(1);
    points.step_by(stride).unzip()
}

fn with_band(
    axis: Axis,
    times: &[f64],
    bands: &Bands<[f64; quantity::COUNT]>,
    index: usize,
    truth: &[f64],
) -> Panel {
    let rows = || bands.means.iter().zip(&bands.deviations);
    let edge = |side: f64| -> Vec<f64> {
        rows()
            .map(|(mean, deviation)| mean[index] + side * NORMAL_95 * deviation[index])
            .collect()
    };
    let mean: Vec<f64> = rows().map(|(mean, _)| mean[index]).collect();
    let panel = Panel::new(axis)
        .series(Series::band("95 %", times, &edge(-1.0), &edge(1.0)).color(BLUE))
        .series(
            Series::line("estimated", times, &mean)
                .color(BLUE)
                .dash(Dash::Solid),
        );
    if truth.is_empty() {
        return panel;
    }
    panel.series(
        Series::line("true", times, truth)
            .color(BLACK)
            .dash(Dash::Dashed),
    )
}
