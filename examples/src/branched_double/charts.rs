//! The four charts of the paper, as SVG, PNG and PDF.

use std::f64::consts::PI;

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series};

use super::apparatus::{DIFFERENCE, EXACT, MEAN, PUBLISHED, Sample, folded};
use super::arguments::Arguments;
use super::experiment::Run;
use super::findings::Frequencies;
use super::spectrum;
use super::table::three_digits;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;
use branched_pendulum_frame::figures::TimeSpan;

/// Initial angles (degrees) that the paper compares: at the smaller one θ_d just does not grow, at
/// the larger one it just does.
const COMPARED: [f64; 2] = [47.6, 47.8];

/// Largest number of panels at which the chart of θ_d is still legible.
const MOST_PANELS: usize = 8;

/// Colours of the quantities, the same in all charts.
const BLUE: Color = Color::rgb(0, 114, 178);
const ORANGE: Color = Color::rgb(213, 94, 0);
const GREEN: Color = Color::rgb(0, 158, 115);

/// Default duration that the charts against time show, in s: the onset of the growth.
const ONSET: f64 = 10.0;

/// Largest number of angles of release whose curves of θ_d share one panel. With more, each has its
/// own panel.
const MOST_TOGETHER: usize = 2;

/// Draws the charts. Without runs, draws nothing.
///
/// # Errors [`Failure::Chart`], [`Failure::Spectrum`] or [`Failure::File`].
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
    let shown = job.shown().unwrap_or(TimeSpan {
        from: 0.0,
        to: ONSET.min(arguments.duration),
    });
    job.chart("antiphase-angle", &antiphase_angle(arguments, shown, runs))?;
    job.chart(
        "energy-and-transfer",
        &energy_and_transfer(arguments, shown, &pair),
    )?;
    job.chart(
        "transfer-by-part",
        &transfer_by_part(arguments, shown, growing),
    )?;
    let spectrum = spectrum::chart(arguments, frequencies, runs, &pair)?;
    job.chart("spectrum", &spectrum)
}

/// Returns the runs nearest to the two angles that the paper compares, by ascending angle; one run
/// if there is only one.
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

/// Returns the chart of θ_d against time: two angles share a panel; if there are more, each has its
/// own.
fn antiphase_angle(arguments: &Arguments, shown: TimeSpan, runs: &[Run]) -> Chart {
    let drawn = spread(runs, MOST_PANELS);
    let mut title = format!("θ_d, folded to ±π/2; {}", arguments.conditions());
    if drawn.len() < runs.len() {
        title.push_str(&format!(" ({} of {} angles)", drawn.len(), runs.len()));
    }
    let curves: Vec<(&Run, Vec<f64>)> = drawn
        .into_iter()
        .map(|run| {
            let angles = within(run, shown).iter().map(|s| s.coordinates[DIFFERENCE]);
            (run, folded_with_gaps(angles))
        })
        .collect();
    let all = curves.iter().flat_map(|(_, curve)| curve.iter().copied());
    let range = common_range(all);
    let chart = Chart::new(title, time(shown));
    let panel = || Panel::new(ranged("θ_d (rad)", range)).zero_line();
    let line = |name: &str, run: &Run, curve: &[f64]| {
        Series::line(name, &times(run, shown), curve).dash(Dash::Solid)
    };
    if curves.len() <= MOST_TOGETHER {
        let panel = curves.iter().fold(panel(), |panel, (run, curve)| {
            panel.series(line(&run.release(), run, curve))
        });
        return chart.size(900.0, 420.0).panel(panel);
    }
    let height = 170.0 + 120.0 * curves.len() as f64;
    let chart = chart.size(900.0, height);
    curves.iter().fold(chart, |chart, (run, curve)| {
        let panel = panel().name(run.release());
        chart.panel(panel.series(line("", run, curve).color(BLUE)))
    })
}

/// Returns the chart of H_d and W for the two angles compared, on the same scales.
fn energy_and_transfer(arguments: &Arguments, shown: TimeSpan, pair: &[&Run]) -> Chart {
    let title = format!("H_d and its rate of change W; {}", arguments.conditions());
    let energies = |run: &Run| column(run, shown, |s| 1e3 * s.antiphase_energy);
    let transfer = |run: &Run, form: usize| {
        column(run, shown, |s| {
            s.flow
                .transfer
                .get(form)
                .map_or(f64::NAN, |w| 1e3 * w.total())
        })
    };
    let energy_range = common_range(pair.iter().flat_map(|run| energies(run)));
    // The published form leaves the scale where θ_d is no longer small.
    let transfer_range = common_range(pair.iter().flat_map(|run| transfer(run, EXACT)));
    let chart = Chart::new(title, time(shown));
    pair.iter().fold(
        chart.size(900.0, 150.0 + 290.0 * pair.len() as f64),
        |chart, run| {
            let times = times(run, shown);
            let line = |name: &str, values: &[f64], color: Color, dash: Dash| {
                Series::line(name, &times, values).color(color).dash(dash)
            };
            let name = "W published";
            let published = transfer(run, PUBLISHED);
            let cut = cut_off(name, transfer_range, &[&published]);
            let energy = line("", &energies(run), BLUE, Dash::Solid);
            let published = line(name, &published, ORANGE, Dash::Dashed);
            let exact = line("W exact", &transfer(run, EXACT), GREEN, Dash::Solid);
            chart
                .panel(
                    Panel::new(ranged("H_d (mJ)", energy_range))
                        .name(run.release())
                        .zero_line()
                        .series(energy),
                )
                .panel(
                    Panel::new(ranged("W (mW)", transfer_range))
                        .name(run.release() + &cut)
                        .zero_line()
                        .series(published)
                        .series(exact),
                )
        },
    )
}

/// Returns the chart of W_K and W_P, as published and exact, with H_d and θ_m, for the run in which
/// θ_d grows.
fn transfer_by_part(arguments: &Arguments, shown: TimeSpan, run: &Run) -> Chart {
    let title = format!(
        "W by part for {}; {}",
        run.release(),
        arguments.conditions()
    );
    let times = times(run, shown);
    let part = |form: usize, kinetic: bool| {
        column(run, shown, |sample| {
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
        let [kinetic, potential] = [true, false].map(|kinetic| part(form, kinetic));
        let cut = cut_off("this form", range, &[&kinetic, &potential]);
        let line = |name: &str, values: &[f64]| Series::line(name, &times, values);
        Panel::new(ranged("power (mW)", range))
            .name(name.to_owned() + &cut)
            .zero_line()
            .series(line("W_K", &kinetic).color(ORANGE).dash(Dash::Dashed))
            .series(line("W_P", &potential).color(GREEN).dash(Dash::Solid))
    };
    let alone = |axis: &str, values: Vec<f64>| {
        let line = Series::line("", &times, &values).color(BLUE);
        Panel::new(Axis::linear(axis))
            .zero_line()
            .series(line.dash(Dash::Solid))
    };
    let energies = column(run, shown, |s| 1e3 * s.antiphase_energy);
    let means = column(run, shown, |s| s.coordinates[MEAN]);
    Chart::new(title, time(shown))
        .size(900.0, 800.0)
        .panel(alone("H_d (mJ)", energies))
        .panel(parts(PUBLISHED, "published"))
        .panel(parts(EXACT, "exact"))
        .panel(alone("θ_m (rad)", means))
}

/// Returns at most `most` of the runs, evenly spread and including the first and the last.
fn spread(runs: &[Run], most: usize) -> Vec<&Run> {
    let shown = runs.len().min(most);
    let steps = shown.saturating_sub(1).max(1);
    (0..shown)
        .filter_map(|index| runs.get(index * (runs.len() - 1) / steps))
        .collect()
}

/// Folds angles, with a gap (NaN) in the curve where they jump from one end of the range to the
/// other.
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

/// Returns the time axis for the span that is shown.
fn time(shown: TimeSpan) -> Axis {
    Axis::linear("time after release (s)").range(shown.from, shown.to)
}

/// Returns the samples within a time span and one more on each side, so that lines reach the edges
/// of the panel.
fn within(run: &Run, shown: TimeSpan) -> &[Sample] {
    let samples = &run.samples;
    let first = samples.partition_point(|sample| sample.time < shown.from);
    let end = samples.partition_point(|sample| sample.time <= shown.to);
    let both = first.saturating_sub(1)..samples.len().min(end + 1);
    samples.get(both).unwrap_or(samples)
}

fn column(run: &Run, shown: TimeSpan, value: impl Fn(&Sample) -> f64) -> Vec<f64> {
    within(run, shown).iter().map(value).collect()
}

fn times(run: &Run, shown: TimeSpan) -> Vec<f64> {
    column(run, shown, |sample| sample.time)
}

/// Describes how far curves (mW) extend beyond the range of their panel; empty if none is cut off.
fn cut_off(name: &str, range: Option<(f64, f64)>, curves: &[&[f64]]) -> String {
    let values = || curves.iter().copied().flatten().copied();
    let least = values().fold(f64::INFINITY, f64::min);
    let most = values().fold(f64::NEG_INFINITY, f64::max);
    match range {
        Some((low, high)) if least < low || most > high => {
            let [low, high, least, most] = [low, high, least, most].map(three_digits);
            format!("; {name} is cut off at {low} and {high} mW, it goes from {least} to {most} mW")
                .replace('-', "−")
        }
        _ => String::new(),
    }
}

/// Returns the range of all values, with a margin; `None` if it has no extent.
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
    use super::{common_range, compared, cut_off, folded_with_gaps, spread};
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

    #[test]
    fn a_curve_that_leaves_its_panel_is_told() {
        let range = Some((-1.0, 2.0));
        assert_eq!(cut_off("W", range, &[&[-1.0, 2.0], &[f64::NAN]]), "");
        assert_eq!(cut_off("W", None, &[&[-1.0, 2.0]]), "");
        assert_eq!(
            cut_off("W", range, &[&[0.5], &[0.0, 25.0]]),
            "; W is cut off at −1.00 and 2.00 mW, it goes from 0.00e0 to 25.0 mW"
        );
    }
}
