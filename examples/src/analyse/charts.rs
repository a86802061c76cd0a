//! θ_d, H_d and W against time, with their errors.

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series};

use super::estimate::{Estimate, quantity};
use super::source::Source;

const BLUE: Color = Color::rgb(0, 114, 178);
const BLACK: Color = Color::rgb(0, 0, 0);
const LIGHT: Color = Color::rgb(176, 208, 232);

/// Half the width of a band that holds 95 % of a normal distribution.
const NORMAL_95: f64 = 1.96;

/// Draws the estimate; a simulated camera's truth is dashed.
pub fn chart(source: &Source, estimate: &Estimate) -> Chart {
    let times = &source.times;
    let difference: Vec<f64> = estimate.motion.iter().map(|state| state[2]).collect();
    let data: Vec<f64> = source
        .angles
        .iter()
        .map(|angles| match *angles {
            [_, Some(two), Some(three)] => 0.5 * (two - three),
            _ => f64::NAN,
        })
        .collect();
    let angle = Panel::new(Axis::linear("θ_d (rad)"))
        .series(Series::points("measured", times, &data).color(LIGHT))
        .series(
            Series::line("estimated", times, &difference)
                .color(BLUE)
                .dash(Dash::Solid),
        )
        .zero_line();
    let energy = with_band(Axis::linear("H_d (J)"), source, estimate, quantity::ENERGY);
    let transfer =
        with_band(Axis::linear("W (W)"), source, estimate, quantity::TRANSFER).zero_line();
    let closure = with_band(
        Axis::linear("∫ dH_d/dt dt − ΔH_d (J)"),
        source,
        estimate,
        quantity::CLOSURE,
    );
    Chart::new(
        "Energy of the antiphase mode from measured angles",
        Axis::linear("t (s)"),
    )
    .panel(angle)
    .panel(energy)
    .panel(transfer)
    .panel(closure.zero_line())
}

fn with_band(axis: Axis, source: &Source, estimate: &Estimate, index: usize) -> Panel {
    let rows = || estimate.bands.means.iter().zip(&estimate.bands.deviations);
    let edge = |side: f64| -> Vec<f64> {
        rows()
            .map(|(mean, deviation)| mean[index] + side * NORMAL_95 * deviation[index])
            .collect()
    };
    let mean: Vec<f64> = rows().map(|(mean, _)| mean[index]).collect();
    let panel = Panel::new(axis)
        .series(Series::band("95 %", &source.times, &edge(-1.0), &edge(1.0)).color(LIGHT))
        .series(
            Series::line("estimated", &source.times, &mean)
                .color(BLUE)
                .dash(Dash::Solid),
        );
    let truth: Option<Vec<f64>> = match index {
        quantity::ENERGY => Some(source.truth.iter().map(|s| s.antiphase_energy).collect()),
        quantity::TRANSFER => Some(
            source
                .truth
                .iter()
                .map(|s| s.flow.transfer[2].total())
                .collect(),
        ),
        _ => None,
    };
    match truth {
        Some(truth) if !truth.is_empty() => panel.series(
            Series::line("true", &source.times, &truth)
                .color(BLACK)
                .dash(Dash::Dashed),
        ),
        _ => panel,
    }
}
