//! Charts: the course of the energies, the scales, the densities of the fluxes; and the
//! tree in motion.

use branched_pendulum::analysis::statistics::Average;
use branched_pendulum_charts::{Axis, Chart, ChartError, Film, FilmLink, Panel, Series};

use super::arguments::Arguments;
use super::findings::{Findings, Scale};
use super::report::name;
use super::scene::Shape;

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
pub fn scales(arguments: &Arguments, findings: &Findings) -> Option<Chart> {
    let shape = arguments.shape();
    let (mut places, mut energies) = (Vec::new(), Vec::new());
    for (scale, state) in findings.scales.iter().enumerate() {
        if let Scale::Awake(average) = state {
            let freedoms = shape.degrees_of_freedom(scale) as f64;
            places.push(scale as f64);
            energies.push(
                [
                    average.mean - average.error,
                    average.mean,
                    average.mean + average.error,
                ]
                .map(|energy| energy / freedoms),
            );
        }
    }
    let mut energy = Panel::new(Axis::log("energy per degree of freedom (J)"));
    if !places.is_empty() {
        let [low, middle, high] = columns(&energies);
        energy = energy
            .band("", &places, &low, &high)
            .series(Series::line("energy per degree of freedom", &places, &middle).with_symbols());
    }
    let mut flux = Panel::new(Axis::linear("power (mW)")).zero_line();
    let known: Vec<(f64, [f64; 3], [f64; 3])> = findings
        .fluxes
        .iter()
        .enumerate()
        .filter_map(|(index, flux)| {
            let flux = flux.as_ref().ok()?;
            let bar =
                |a: &Average| [a.mean - a.error, a.mean, a.mean + a.error].map(|power| 1e3 * power);
            Some((
                index as f64 + 1.0,
                bar(&flux.transferred),
                bar(&flux.dissipated),
            ))
        })
        .collect();
    let x: Vec<f64> = known.iter().map(|(x, ..)| *x).collect();
    if !x.is_empty() {
        let [low, middle, high] = columns(&known.iter().map(|(_, w, _)| *w).collect::<Vec<_>>());
        flux = flux
            .band("", &x, &low, &high)
            .series(Series::line("flux into the scale by W", &x, &middle).with_symbols());
        let [low, middle, high] = columns(&known.iter().map(|(.., d)| *d).collect::<Vec<_>>());
        flux = flux
            .band("", &x, &low, &high)
            .series(Series::line("dissipated there and below", &x, &middle).with_symbols());
    }
    if places.is_empty() || x.is_empty() {
        return None;
    }
    if let Ok(input) = &findings.input {
        flux = flux.points("motor", &[0.0], &[1e3 * input.mean]);
    }
    let chart = Chart::new(
        "The steady state by scale; bands: one standard error",
        Axis::linear("generation in which the branches differ (0: means)"),
    )
    .size(900.0, 760.0)
    .panel(energy)
    .panel(flux);
    Some(chart)
}

fn columns(rows: &[[f64; 3]]) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|column| rows.iter().map(|row| row[column]).collect())
}

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
    panel = panel.line("normal", &x, &normal);
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
pub fn film(shape: &Shape, states: &[Vec<f64>], interval: f64) -> Result<Film, ChartError> {
    let mut links = Vec::new();
    for generation in 0..shape.generations {
        for place in 0..shape.width(generation) {
            let above = generation.checked_sub(1);
            let joint = above.map_or(0.0, |above| shape.length(above));
            links.push(FilmLink {
                parent: above.map(|above| shape.link(above, place % shape.width(above))),
                pivot: [joint, 0.0],
                end: [shape.length(generation), 0.0],
            });
        }
    }
    let pictures: Vec<&[f64]> = states.iter().map(|state| &state[..links.len()]).collect();
    let title = format!("{} rods, the root driven by a motor", links.len());
    Film::new(title, interval).tree("", &links, &pictures)
}
