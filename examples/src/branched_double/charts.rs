//! The four charts of the paper, as SVG, PNG and PDF, and the film of the releases.

use std::f64::consts::PI;

use branched_pendulum::Positions;
use branched_pendulum_charts::{Axis, Chart, Color, Dash, Film, Panel, Series};
use branched_pendulum_frame::film::links;
use branched_pendulum_frame::{Failure, Job};

use super::apparatus::{BranchedDouble, EXACT, PUBLISHED, Sample, folded};
use super::findings::Frequencies;
use super::release::Run;
use super::{Arguments, RATE, spectrum};

/// Initial angles (degrees) that the paper compares: at the larger one θ_d just grows, at the
/// smaller one it just does not.
const COMPARED: [f64; 2] = [47.8, 47.6];

/// Largest number of panels at which the chart of θ_d is still legible.
const MOST_PANELS: usize = 8;

/// Largest number of angles of release whose curves of θ_d share one panel. With more, each has its
/// own panel.
const MOST_TOGETHER: usize = 2;

/// Colours of the quantities, the same in all charts.
const BLUE: Color = Color::rgb(0, 114, 178);
const ORANGE: Color = Color::rgb(213, 94, 0);
const GREEN: Color = Color::rgb(0, 158, 115);

/// Words in the names of panels whose scale is that of the exact W: the published form leaves it
/// where θ_d is no longer small.
const MARKED: &str = "; marked where W leaves the panel";

/// Time span (s from the release) of the charts over time by default: the onset of the growth.
const ONSET: f64 = 10.0;

/// Draws the charts. Without runs, draws nothing.
///
/// # Errors
/// [`Failure::Chart`], [`Failure::Spectrum`] or [`Failure::File`].
pub fn write(
    job: &Job,
    arguments: &Arguments,
    frequencies: Frequencies,
    runs: &[Run],
) -> Result<(), Failure> {
    let [from, to] = match job.shown() {
        Some(span) => [span.from, span.to],
        None => [0.0, ONSET.min(arguments.duration)],
    };
    let axis = Axis::linear("time after release (s)").range(from, to);
    // One more sample on each side: lines reach the edges of a panel.
    let margin = 1.0 / RATE;
    let shown = runs
        .iter()
        .map(|run| run.between(from - margin, to + margin));
    let shown: Vec<Run> = shown.collect();
    let pair = compared(&shown);
    let Some(growing) = pair.last() else {
        return Ok(());
    };
    let chart = |subject: &str| {
        let title = format!("{subject}; {}", arguments.conditions());
        Chart::new(title, axis.clone())
    };
    job.chart("antiphase-angle", &antiphase_angle(chart, &shown))?;
    job.chart("energy-and-transfer", &energy_and_transfer(chart, &pair))?;
    job.chart("transfer-by-part", &transfer_by_part(chart, growing))?;
    let spectrum = spectrum::chart(arguments, frequencies, runs)?;
    job.chart("spectrum", &spectrum)
}

/// Returns the runs nearest to the two angles that the paper compares, by ascending angle; one run
/// if there is only one.
pub fn compared(runs: &[Run]) -> Vec<&Run> {
    let mut left: Vec<&Run> = runs.iter().collect();
    let mut pair = Vec::new();
    for angle in COMPARED {
        let distance = |run: &Run| (run.angle_deg - angle).abs();
        left.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
        pair.extend(left.pop());
    }
    pair.sort_by(|a, b| a.angle_deg.total_cmp(&b.angle_deg));
    pair
}

/// Draws θ_d against time: two angles share a panel; if there are more, each has its own.
fn antiphase_angle(chart: impl Fn(&str) -> Chart, runs: &[Run]) -> Chart {
    let stride = runs.len().div_ceil(MOST_PANELS).max(1);
    let drawn: Vec<&Run> = runs.iter().step_by(stride).collect();
    let part = match stride {
        1 => String::new(),
        _ => format!(" ({} of {} angles)", drawn.len(), runs.len()),
    };
    let chart = chart(&format!("θ_d, folded to ±π/2{part}"));
    let curve = |run: &Run| folded_with_gaps(&run.column(|sample| sample.difference));
    let axis = axis_of("θ_d (rad)", drawn.iter().flat_map(|run| curve(run)));
    let panel = Panel::new(axis).zero_line();
    let line = |name: String, run: &Run| {
        let line = Series::line(name, &run.times(), &curve(run));
        line.dash(Dash::Solid)
    };
    if drawn.len() <= MOST_TOGETHER {
        let lines = drawn.iter().map(|run| line(run.release(), run));
        return chart
            .size(900.0, 420.0)
            .panel(lines.fold(panel, Panel::series));
    }
    let chart = chart.size(900.0, 170.0 + 120.0 * drawn.len() as f64);
    drawn.iter().fold(chart, |chart, run| {
        let line = line(String::new(), run).color(BLUE);
        chart.panel(panel.clone().name(run.release()).series(line))
    })
}

/// Draws H_d and W for the angles compared, on the same scales.
fn energy_and_transfer(chart: impl Fn(&str) -> Chart, pair: &[&Run]) -> Chart {
    let energy = |sample: &Sample| 1e3 * sample.antiphase_energy;
    let transfer = |form: usize| move |sample: &Sample| 1e3 * sample.powers.transfer(form).total();
    let energies = pair.iter().flat_map(|run| run.column(energy));
    let energies = Panel::new(axis_of("H_d (mJ)", energies)).zero_line();
    let exact = pair.iter().flat_map(|run| run.column(transfer(EXACT)));
    let transfers = Panel::new(axis_of("W (mW)", exact)).zero_line();
    let chart = chart("H_d and its rate of change W");
    let chart = chart.size(900.0, 150.0 + 290.0 * pair.len() as f64);
    pair.iter().fold(chart, |chart, run| {
        let published = line("W published", run, ORANGE, transfer(PUBLISHED));
        let exact = line("W exact", run, GREEN, transfer(EXACT));
        let energies = energies.clone().name(run.release());
        let transfers = transfers.clone().name(run.release() + MARKED);
        let transfers = transfers.series(published.dash(Dash::Dashed).mark_beyond());
        chart
            .panel(energies.series(line("", run, BLUE, energy)))
            .panel(transfers.series(exact))
    })
}

/// Draws W_K and W_P, as published and exact, with H_d and θ_m, for one run.
fn transfer_by_part(chart: impl Fn(&str) -> Chart, run: &Run) -> Chart {
    let kinetic = |form: usize| move |sample: &Sample| 1e3 * sample.powers.transfer(form).kinetic;
    let potential =
        |form: usize| move |sample: &Sample| 1e3 * sample.powers.transfer(form).potential;
    let exact = [run.column(kinetic(EXACT)), run.column(potential(EXACT))];
    let powers = Panel::new(axis_of("power (mW)", exact.concat())).zero_line();
    let parts = |form: usize, name: &str| {
        let kinetic = line("W_K", run, ORANGE, kinetic(form)).dash(Dash::Dashed);
        let potential = line("W_P", run, GREEN, potential(form));
        let panel = powers.clone().name(name).series(kinetic.mark_beyond());
        panel.series(potential.mark_beyond())
    };
    let alone = |label: &str, of: &dyn Fn(&Sample) -> f64| {
        let panel = Panel::new(Axis::linear(label)).zero_line();
        panel.series(line("", run, BLUE, of))
    };
    chart(&format!("W by part for {}", run.release()))
        .size(900.0, 800.0)
        .panel(alone("H_d (mJ)", &|sample| 1e3 * sample.antiphase_energy))
        .panel(parts(PUBLISHED, &format!("published{MARKED}")))
        .panel(parts(EXACT, "exact"))
        .panel(alone("θ_m (rad)", &|sample| sample.mean))
}

/// Folds angles, with a gap (NaN) in the curve where they jump from one end of the range to the
/// other.
pub fn folded_with_gaps(angles: &[f64]) -> Vec<f64> {
    let turns = |angle: f64| (angle / PI).round();
    let mut previous = angles.first().copied().unwrap_or_default();
    let folded = angles.iter().map(|angle| {
        let leaps = turns(*angle) != turns(previous);
        previous = *angle;
        if leaps { f64::NAN } else { folded(*angle) }
    });
    folded.collect()
}

/// Creates a y axis that shows all of these values, and zero, with a margin.
fn axis_of(label: &str, values: impl IntoIterator<Item = f64>) -> Axis {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) = finite.fold((0.0_f64, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let margin = 0.04 * (high - low);
    match margin > 0.0 {
        true => Axis::linear(label).range(low - margin, high + margin),
        false => Axis::linear(label),
    }
}

/// Creates a solid line of one quantity against time.
fn line(name: &str, run: &Run, color: Color, of: impl Fn(&Sample) -> f64) -> Series {
    let line = Series::line(name, &run.times(), &run.column(of));
    line.color(color).dash(Dash::Solid)
}

/// Pictures per second of the film; browsers interpolate between them.
const PICTURES: f64 = 20.0;

/// Writes a film of all releases, one next to the other. A child is drawn as long as the simple
/// pendulum with the same period, I/(m d) + d.
///
/// # Errors
/// [`Failure::Chart`] or [`Failure::File`].
pub fn write_film(job: &Job, model: &BranchedDouble, runs: &[Run]) -> Result<(), Failure> {
    let mut links = links(model);
    for (index, link) in links.iter_mut().enumerate().skip(1) {
        if let Some(child) = model.properties_of(index) {
            let [along, _] = child.centre;
            link.end = [child.inertia / (child.mass * along) + along, 0.0];
        }
    }
    let stride = (RATE / PICTURES).round() as usize;
    let title = "Releases of the branched double pendulum";
    let mut film = Film::new(title, stride as f64 / RATE);
    for run in runs {
        let pictures = run.samples.iter().step_by(stride);
        let pictures: Vec<[f64; 3]> = pictures.map(|sample| sample.theta).collect();
        film = film.tree(format!("θ_1(0) = {}°", run.angle_deg), &links, &pictures)?;
    }
    job.film("releases", &film)
}
