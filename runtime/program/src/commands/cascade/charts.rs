//! Charts of a cascade: energies against time, energies and fluxes of the scales, distributions of
//! the fluxes; and a film of the tree.

use branched_pendulum::analysis::statistics::Average;
use branched_pendulum_charts::{
    Axis, Chart, ChartError, Color, Dash, Film, Panel, Series, verbatim,
};

use super::arguments::Arguments;
use super::equilibrium::Equilibrium;
use super::findings::{Findings, ScaleState};
use super::report::name;
use super::tree::DrivenTree;
use crate::frame::film;

/// Draws the energies of the scales against time, averaged over the starts.
pub fn energy_history(arguments: &Arguments, findings: &Findings) -> Chart {
    let windows = findings.course.first().map_or(0, Vec::len);
    let time = |window: usize| (window as f64 + 0.5) / arguments.frequency;
    let times: Vec<f64> = (0..windows).map(time).collect();
    let largest = findings
        .course
        .iter()
        .flatten()
        .copied()
        .fold(0.0, f64::max);
    let mut panel = Panel::new(Axis::log("energy (J)").range(1e-4 * largest, 2.0 * largest));
    for (scale, energies) in findings.course.iter().enumerate() {
        // A level that sleeps lies below the axis.
        if energies.iter().any(|energy| *energy > 1e-4 * largest) {
            panel = panel.line(name(scale), &times, energies);
        }
    }
    if let Ok(transient) = findings.transient {
        panel = panel.vertical(transient as f64 / arguments.frequency, "steady from here");
    }
    Chart::new("Energy by scale, mean of all starts", Axis::linear("t (s)")).panel(panel)
}

/// Draws the energy per degree of freedom and the flux of each scale; `None` if nothing has reached
/// a steady state.
pub fn scales(
    arguments: &Arguments,
    driven: &DrivenTree,
    findings: &Findings,
    equilibrium: Option<&Equilibrium>,
) -> Option<Chart> {
    let energies = (0..).zip(&findings.scales).filter_map(|(scale, state)| {
        let ScaleState::Awake(average) = state else {
            return None;
        };
        let freedoms = driven.degrees_of_freedom(scale) as f64;
        Some([
            scale as f64,
            average.mean / freedoms,
            average.error / freedoms,
        ])
    });
    let energies: Vec<[f64; 3]> = energies.collect();
    let fluxes = (1..).zip(&findings.fluxes);
    let fluxes = fluxes.filter_map(|(scale, flux)| Some((f64::from(scale), flux.as_ref().ok()?)));
    let milliwatts = |scale: f64, power: &Average| [scale, 1e3 * power.mean, 1e3 * power.error];
    let (given, lost): (Vec<_>, Vec<_>) = fluxes
        .map(|(scale, flux)| {
            let given = milliwatts(scale, &flux.transferred);
            (given, milliwatts(scale, &flux.dissipated))
        })
        .unzip();
    if energies.is_empty() || given.is_empty() {
        return None;
    }
    let energy = Panel::new(Axis::log("energy per degree of freedom (J)"));
    let mut energy = averages(energy, "energy", &energies);
    if let Some(equilibrium) = equilibrium {
        let [thermal, ..] = &equilibrium.scales;
        let rows = thermal.iter().enumerate().map(|(scale, own)| {
            let freedoms = driven.degrees_of_freedom(scale) as f64;
            [scale as f64, own.value / freedoms, own.error / freedoms]
        });
        let rows: Vec<[f64; 3]> = rows.collect();
        energy = averages(energy, "in equilibrium at the same energy", &rows);
    }
    let flux = Panel::new(Axis::linear("power (mW)")).zero_line();
    let flux = averages(flux, "flux into the scale by W", &given);
    let mut flux = averages(flux, "dissipated there and below", &lost);
    if let Ok(input) = &findings.input {
        flux = averages(flux, arguments.source(), &[milliwatts(0.0, input)]);
    }
    let chart = Chart::new(
        "The steady state by scale; bars: one standard error",
        Axis::linear("generation in which the branches differ (0: means)").whole(),
    )
    .columns(2)
    .size(1100.0, 480.0);
    Some(chart.panel(energy).panel(flux))
}

/// Adds averages with error bars to a panel; each row is position, value and error.
fn averages(panel: Panel, label: &str, rows: &[[f64; 3]]) -> Panel {
    let column = |value: fn(&[f64; 3]) -> f64| rows.iter().map(value).collect::<Vec<f64>>();
    let (x, mean) = (column(|row| row[0]), column(|row| row[1]));
    let line = Series::line(label, &x, &mean).with_symbols();
    panel.series(line.errors(&column(|row| row[2])))
}

/// Colour of values for comparison; no scale has it.
const GREY: Color = Color::rgb(150, 150, 150);

/// Draws the distributions of the fluxes, scaled to zero mean and unit variance.
pub fn densities(findings: &Findings) -> Chart {
    let mut panel = Panel::new(Axis::log("density").range(1e-6, 3.0));
    for (index, density) in findings.densities.iter().enumerate() {
        let points = density.standardised(0.1);
        let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        if x.iter().zip(&y).any(|(x, y)| x.is_finite() && *y > 1e-6) {
            panel = panel.line(format!("into scale {}", index + 1), &x, &y);
        }
    }
    let x: Vec<f64> = (-60..=60).map(|i| 0.1 * f64::from(i)).collect();
    let normal: Vec<f64> = x
        .iter()
        .map(|x| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt())
        .collect();
    let normal = Series::line("normal", &x, &normal);
    panel = panel.series(normal.color(GREY).dash(Dash::Solid));
    Chart::new(
        "Density of the flux into a scale and all younger ones",
        Axis::linear("(W − mean)/σ").range(-20.0, 20.0),
    )
    .panel(panel)
}

/// Creates a film of the tree from states that are `interval` seconds apart.
///
/// # Errors
/// [`ChartError`] if there is nothing to show.
pub fn film(driven: &DrivenTree, states: &[Vec<f64>], interval: f64) -> Result<Film, ChartError> {
    let tree = &driven.subject.tree;
    let angles = |state: &Vec<f64>| film::angles(tree, &state[..driven.links()]);
    let pictures: Vec<Vec<f64>> = states.iter().map(angles).collect();
    let title = format!("{}, driven", verbatim(&driven.subject.name));
    Film::new(title, interval).tree("", &film::links(tree), &pictures)
}
