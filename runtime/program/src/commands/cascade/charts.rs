//! Charts: the course of the energies, the scales, the densities of the fluxes; and the
//! tree in motion.

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

/// Energies of the scales against time, averaged over the starts.
pub fn course(arguments: &Arguments, findings: &Findings) -> Chart {
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

/// Energy per degree of freedom, and flux, by scale; none where nothing has settled.
pub fn scales(
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
        flux = flux.points("motor", &[0.0], &[1e3 * input.mean]);
    }
    let chart = Chart::new(
        "The steady state by scale; bands: one standard error",
        Axis::linear("generation in which the branches differ (0: means)"),
    )
    .columns(2)
    .size(1100.0, 480.0);
    Some(chart.panel(energy).panel(flux))
}

/// Adds averages, each with its place before it and its error behind.
fn averages(panel: Panel, label: &str, rows: &[[f64; 3]]) -> Panel {
    let column = |value: fn(&[f64; 3]) -> f64| rows.iter().map(value).collect::<Vec<f64>>();
    let (x, mean) = (column(|row| row[0]), column(|row| row[1]));
    let (low, high) = (column(|row| row[1] - row[2]), column(|row| row[1] + row[2]));
    panel
        .band(label, &x, &low, &high)
        .series(Series::line(label, &x, &mean).with_symbols())
}

/// Color of what is there to be compared with, which no scale has.
const GREY: Color = Color::rgb(150, 150, 150);

/// Densities of the fluxes, of zero mean and unit variance.
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

/// The tree through states that follow each other by `interval` seconds.
///
/// # Errors
/// [`ChartError`] if there is nothing to be seen.
pub fn film(driven: &DrivenTree, states: &[Vec<f64>], interval: f64) -> Result<Film, ChartError> {
    let tree = &driven.subject.tree;
    let angles = |state: &Vec<f64>| film::angles(tree, &state[..driven.links()]);
    let pictures: Vec<Vec<f64>> = states.iter().map(angles).collect();
    let title = format!("{}, driven", verbatim(&driven.subject.name));
    Film::new(title, interval).tree("", &film::links(tree), &pictures)
}
