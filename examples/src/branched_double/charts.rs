//! The four charts of the paper, as SVG and PNG.

use std::f64::consts::PI;

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series};
use branched_pendulum_measure::{Spectrum, SpectrumOptions};

use super::apparatus::{DIFFERENCE, EXACT, MEAN, PUBLISHED, Sample, folded};
use super::arguments::Arguments;
use super::experiment::Run;
use super::findings::Frequencies;
use super::lines;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;
use branched_pendulum_frame::command_line::plain;

/// Initial angles, in degrees, that the paper compares: just without growth,
/// and just with it.
const COMPARED: [f64; 2] = [47.6, 47.8];

/// Most panels of the chart of θ_d that can be read.
const MOST_PANELS: usize = 8;

/// Colours of the quantities, the same in all charts.
const BLUE: Color = Color::rgb(0, 114, 178);
const ORANGE: Color = Color::rgb(213, 94, 0);
const GREEN: Color = Color::rgb(0, 158, 115);

/// The charts against time show the onset: this time, s.
const ONSET: f64 = 10.0;

/// The frequencies shown, Hz.
const SPECTRUM_TOP: f64 = 3.0;

/// Draws the charts. Nothing is drawn without a run.
///
/// # Errors
/// [`Failure::Chart`], [`Failure::Spectrum`] or [`Failure::File`].
pub fn write(
    job: &Job,
    arguments: &Arguments,
    frequencies: Frequencies,
    runs: &[Run],
) -> Result<(), Failure> {
    let pair = compared(runs);
    let Some(&growing) = pair.last() else {
        return Ok(());
    };
    job.chart("antiphase-angle", &antiphase_angle(arguments, runs))?;
    job.chart(
        "energy-and-transfer",
        &energy_and_transfer(arguments, &pair),
    )?;
    job.chart("transfer-by-part", &transfer_by_part(arguments, growing))?;
    let spectrum = spectrum(arguments, frequencies, runs, &pair)?;
    job.chart("spectrum", &spectrum)
}

/// The runs nearest to the two angles that the paper compares, by ascending
/// angle; a single run where there is but one.
fn compared(runs: &[Run]) -> Vec<&Run> {
    let nearest = |angle: f64, without: Option<&Run>| {
        let others = runs
            .iter()
            .filter(|run| without.is_none_or(|other| run.angle_deg != other.angle_deg));
        others.min_by(|a, b| {
            let distance = |run: &Run| (run.angle_deg - angle).abs();
            distance(a).total_cmp(&distance(b))
        })
    };
    let growing = nearest(COMPARED[1], None);
    let quiet = growing.and_then(|growing| nearest(COMPARED[0], Some(growing)));
    let mut pair: Vec<&Run> = quiet.into_iter().chain(growing).collect();
    pair.sort_by(|a, b| a.angle_deg.total_cmp(&b.angle_deg));
    pair
}

/// θ_d against time, one panel for each of several angles.
fn antiphase_angle(arguments: &Arguments, runs: &[Run]) -> Chart {
    let shown = spread(runs, MOST_PANELS);
    let mut title = format!("θ_d, folded to ±π/2; {}", conditions(arguments));
    if shown.len() < runs.len() {
        title.push_str(&format!(" ({} of {} angles)", shown.len(), runs.len()));
    }
    let curves: Vec<(&Run, Vec<f64>)> = shown
        .into_iter()
        .map(|run| {
            let angles = onset(run).iter().map(|s| s.coordinates[DIFFERENCE]);
            (run, folded_with_gaps(angles))
        })
        .collect();
    let all = curves.iter().flat_map(|(_, curve)| curve.iter().copied());
    let range = common_range(all);
    let height = 170.0 + 110.0 * curves.len() as f64;
    let chart = Chart::new(title, Axis::linear("time after release (s)"));
    curves
        .into_iter()
        .fold(chart.size(900.0, height), |chart, (run, curve)| {
            let label = format!("θ_1(0) = {:?}°", run.angle_deg);
            let panel = Panel::new(ranged("θ_d (rad)", range)).zero_line();
            let line = Series::line(label, &times(onset(run)), &curve);
            chart.panel(panel.series(line.dash(Dash::Solid)))
        })
}

/// H_d and W for the two angles compared, on the same scales.
fn energy_and_transfer(arguments: &Arguments, pair: &[&Run]) -> Chart {
    let title = format!("H_d and its rate of change W; {}", conditions(arguments));
    let energies = |run: &Run| column(run, |s| 1e3 * s.antiphase_energy);
    let transfer = |run: &Run, form: usize| {
        column(run, |s| {
            s.flow
                .transfer
                .get(form)
                .map_or(f64::NAN, |w| 1e3 * w.total())
        })
    };
    let energy_range = common_range(pair.iter().flat_map(|run| energies(run)));
    // The published form leaves the scale where θ_d is no longer small.
    let transfer_range = common_range(pair.iter().flat_map(|run| transfer(run, EXACT)));
    let chart = Chart::new(title, Axis::linear("time after release (s)"));
    pair.iter().fold(
        chart.size(900.0, 150.0 + 290.0 * pair.len() as f64),
        |chart, run| {
            let time = times(onset(run));
            let line = |name: &str, values: Vec<f64>, color: Color, dash: Dash| {
                let label = format!("{name}, {:?}°", run.angle_deg);
                Series::line(label, &time, &values).color(color).dash(dash)
            };
            let energy = line("H_d", energies(run), BLUE, Dash::Solid);
            let published = line(
                "W published",
                transfer(run, PUBLISHED),
                ORANGE,
                Dash::Dashed,
            );
            let exact = line("W exact", transfer(run, EXACT), GREEN, Dash::Solid);
            chart
                .panel(
                    Panel::new(ranged("H_d (mJ)", energy_range))
                        .zero_line()
                        .series(energy),
                )
                .panel(
                    Panel::new(ranged("W (mW)", transfer_range))
                        .zero_line()
                        .series(published)
                        .series(exact),
                )
        },
    )
}

/// W_K and W_P as published and exact, with H_d and θ_m, for the growing case.
fn transfer_by_part(arguments: &Arguments, run: &Run) -> Chart {
    let title = format!(
        "W by part for θ_1(0) = {:?}°; {}",
        run.angle_deg,
        conditions(arguments)
    );
    let time = times(onset(run));
    let part = |form: usize, kinetic: bool| {
        column(run, |sample| {
            sample.flow.transfer.get(form).map_or(f64::NAN, |transfer| {
                1e3 * if kinetic {
                    transfer.kinetic
                } else {
                    transfer.potential
                }
            })
        })
    };
    // The published form leaves the scale where θ_d is no longer small.
    let exact = [part(EXACT, true), part(EXACT, false)];
    let range = common_range(exact.iter().flatten().copied());
    let parts = |form: usize, name: &str| {
        let line = |part_name: &str, kinetic: bool| {
            Series::line(format!("{part_name} {name}"), &time, &part(form, kinetic))
        };
        Panel::new(ranged("power (mW)", range))
            .zero_line()
            .series(line("W_K", true).color(ORANGE).dash(Dash::Dashed))
            .series(line("W_P", false).color(GREEN).dash(Dash::Solid))
    };
    let alone = |axis: &str, name: &str, values: Vec<f64>| {
        let line = Series::line(name, &time, &values).color(BLUE);
        Panel::new(Axis::linear(axis))
            .zero_line()
            .series(line.dash(Dash::Solid))
    };
    let energies = column(run, |s| 1e3 * s.antiphase_energy);
    let means = column(run, |s| s.coordinates[MEAN]);
    Chart::new(title, Axis::linear("time after release (s)"))
        .size(900.0, 760.0)
        .panel(alone("H_d (mJ)", "H_d", energies))
        .panel(parts(PUBLISHED, "published"))
        .panel(parts(EXACT, "exact"))
        .panel(alone("θ_m (rad)", "θ_m", means))
}

/// Amplitude spectrum of θ_m, with the window of Hann.
fn spectrum(
    arguments: &Arguments,
    frequencies: Frequencies,
    runs: &[Run],
    pair: &[&Run],
) -> Result<Chart, Failure> {
    let span = arguments.duration.min(lines::SPAN);
    let top = SPECTRUM_TOP.min(0.5 * arguments.rate);
    // Eight points for each resolved frequency: smooth peaks.
    let count = (8.0 * span * top).round();
    let grid: Vec<f64> = (0..=count as usize)
        .map(|index| top * index as f64 / count)
        .collect();
    let title = format!("Spectrum of θ_m, 0 to {span} s; {}", conditions(arguments));
    let mut series = Vec::new();
    let mut moves = true;
    let lowest = runs
        .first()
        .filter(|run| pair.iter().all(|other| other.angle_deg != run.angle_deg));
    for run in lowest.into_iter().chain(pair.iter().copied()) {
        let samples = lines::mean_angle(run);
        let spectrum =
            Spectrum::at_frequencies(&samples, arguments.rate, &grid, SpectrumOptions::default())?;
        series.push(Series::line(
            format!("θ_1(0) = {:?}°", run.angle_deg),
            &spectrum.frequencies_hz,
            &spectrum.amplitudes,
        ));
        moves &= spectrum.amplitudes.iter().any(|amplitude| *amplitude > 0.0);
    }
    // A pendulum at rest has no place on a logarithmic axis.
    let label = "amplitude of θ_m (rad)";
    let panel = Panel::new(if moves {
        Axis::log(label)
    } else {
        Axis::linear(label)
    });
    let panel = series
        .into_iter()
        .fold(panel, Panel::series)
        .vertical(frequencies.plus, "f_+")
        .vertical(frequencies.antiphase, "f_d")
        .vertical(frequencies.minus, "f_−")
        .vertical(2.0 * frequencies.antiphase, "2f_d");
    Ok(
        Chart::new(title, Axis::linear("frequency (Hz)").range(0.0, top))
            .size(900.0, 520.0)
            .panel(panel),
    )
}

/// The conditions that all runs share, for a title.
pub(super) fn conditions(arguments: &Arguments) -> String {
    let disturbance = plain(arguments.disturbance);
    format!("θ_d(0) = {disturbance} rad, {}", arguments.friction)
}

/// At most `most` of the runs, evenly spread, the first and the last included.
fn spread(runs: &[Run], most: usize) -> Vec<&Run> {
    let shown = runs.len().min(most);
    let steps = shown.saturating_sub(1).max(1);
    (0..shown)
        .filter_map(|index| runs.get(index * (runs.len() - 1) / steps))
        .collect()
}

/// Folded angles, with a gap where they leap from one end to the other.
fn folded_with_gaps(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut previous: Option<f64> = None;
    angles
        .map(|angle| {
            let turns = (angle / PI).round();
            let leaps = previous.replace(turns).is_some_and(|old| old != turns);
            if leaps { f64::NAN } else { folded(angle) }
        })
        .collect()
}

fn onset(run: &Run) -> &[Sample] {
    let end = run.samples.partition_point(|sample| sample.time <= ONSET);
    run.samples.get(..end).unwrap_or(&run.samples)
}

fn column(run: &Run, value: impl Fn(&Sample) -> f64) -> Vec<f64> {
    onset(run).iter().map(value).collect()
}

fn times(samples: &[Sample]) -> Vec<f64> {
    samples.iter().map(|sample| sample.time).collect()
}

/// The range of all values with a margin, or none if it has no extent.
fn common_range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((0.0_f64, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
    let margin = 0.04 * (high - low);
    (margin > 0.0).then_some((low - margin, high + margin))
}

fn ranged(label: &str, range: Option<(f64, f64)>) -> Axis {
    let axis = Axis::linear(label);
    match range {
        Some((low, high)) => axis.range(low, high),
        None => axis,
    }
}

#[cfg(test)]
mod tests {
    use super::{common_range, compared, folded_with_gaps, spread};
    use crate::branched_double::{Run, Work};

    fn runs(angles: &[f64]) -> Vec<Run> {
        let run = |&angle_deg: &f64| Run {
            angle_deg,
            samples: Vec::new(),
            intervals: Vec::new(),
            work: Work::default(),
        };
        angles.iter().map(run).collect()
    }

    fn angles(runs: &[&Run]) -> Vec<f64> {
        runs.iter().map(|run| run.angle_deg).collect()
    }

    #[test]
    fn the_pair_is_that_of_the_paper_or_the_nearest() {
        for (given, pair) in [
            (&[39.5, 47.6, 47.8, 48.6][..], &[47.6, 47.8][..]),
            (&[60.0, 70.0, 80.0], &[60.0, 70.0]),
            (&[10.0, 20.0, 47.7], &[20.0, 47.7]),
            (&[30.0], &[30.0]),
            (&[], &[]),
        ] {
            assert_eq!(angles(&compared(&runs(given))), pair);
        }
    }

    #[test]
    fn many_runs_are_thinned_out_evenly() {
        let many: Vec<f64> = (0..15).map(f64::from).collect();
        assert_eq!(
            angles(&spread(&runs(&many), 8)),
            [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0]
        );
        assert_eq!(angles(&spread(&runs(&many[..3]), 8)), [0.0, 1.0, 2.0]);
        assert!(spread(&[], 8).is_empty());
    }

    #[test]
    fn folding_leaves_a_gap_where_a_child_passes_the_top() {
        let folded = folded_with_gaps([0.1, 1.5, 1.7, 1.9].into_iter());
        assert_eq!(folded[..2], [0.1, 1.5]);
        assert!(folded[2].is_nan());
        assert!((folded[3] - (1.9 - std::f64::consts::PI)).abs() < 1e-15);
    }

    #[test]
    fn a_range_needs_an_extent() {
        assert_eq!(common_range([0.0, f64::NAN].into_iter()), None);
        assert_eq!(common_range([-1.0, 1.0].into_iter()), Some((-1.08, 1.08)));
    }
}
