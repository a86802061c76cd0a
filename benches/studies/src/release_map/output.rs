//! Words, table and chart of a map.

use std::fmt::Write;

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, Symbol};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_measure::CombinationTone;

use super::arguments::{Arguments, Scene};
use super::map::{Map, RATIOS};
use super::normal_modes::NormalMode;
use super::tongues::{Resonance, Tongue, span};
use crate::critical_angle::scan::PAPER;
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Growth rates between which colours change, 1/s.
const RATES: [f64; 2] = [0.01, 5.0];

/// Prints, writes and draws the plane of releases.
///
/// # Errors
/// [`Failure`].
pub fn releases(
    arguments: &Arguments,
    job: &Job,
    map: &Map,
    modes: &[NormalMode],
    tongues: &[Tongue],
) -> Result<(), Failure> {
    if map.is_empty() {
        return Ok(());
    }
    let title = match arguments.scene {
        Scene::Paper => "Growth rate of the antiphase mode after a release from rest",
        Scene::Arms => "Growth rate of a difference between two jointed arms, released from rest",
    };
    job.print(&format!(
        "{}{}{}",
        summary(map),
        told(modes),
        list(arguments, tongues)
    ))?;
    let angles = [
        Column::new("children", "degrees"),
        Column::new("parent", "degrees"),
    ];
    table(job, "release-map", angles, map)?;
    let (mut x, mut y, mut rates) = (Vec::new(), Vec::new(), Vec::new());
    for (children, parent, grown) in map.points() {
        // The other half mirrors this one.
        for sign in [1.0, -1.0] {
            if sign > 0.0 || parent > 0.0 {
                x.push(sign * children);
                y.push(sign * parent);
                rates.push(grown.rate.value);
            }
        }
    }
    let axis =
        Axis::linear("angle of the parent θ_1(0) (°)").range(-arguments.parent, arguments.parent);
    let panel = Panel::new(axis).series(Series::shaded(&x, &y, &rates));
    let panel = modes.iter().zip(LINES).fold(panel, |panel, (mode, color)| {
        let (x, y) = mode.curve();
        let label = format!("nonlinear normal mode f_{}", mode.sign);
        panel.series(Series::line(label, &x, &y).color(color).dash(Dash::Solid))
    });
    let panel = match arguments.scene {
        Scene::Paper => {
            let line = [-arguments.parent, arguments.parent];
            of_the_paper(panel, 0.0, &line, &[-THRESHOLD, THRESHOLD])
        }
        Scene::Arms => panel,
    };
    let x = Axis::linear("common angle of the children (°)");
    let chart = Chart::new(title, x.range(-arguments.children, arguments.children));
    draw(job, "release-map", chart.panel(panel))
}

/// Angle of the parent between the paper's last release without growth and its first with, degrees.
const THRESHOLD: f64 = 0.5 * (PAPER[0] + PAPER[1]);

/// Colours of lines that are seen on dark blue and on yellow.
const LINES: [Color; 3] = [
    Color::rgb(225, 70, 60),
    Color::rgb(70, 200, 245),
    Color::rgb(250, 120, 200),
];

/// Prints, writes and draws the plane of ratio and energy.
///
/// # Errors
/// [`Failure`].
pub fn ratios(job: &Job, map: &Map) -> Result<(), Failure> {
    if map.is_empty() {
        return Ok(());
    }
    job.print(&summary(map))?;
    let columns = [Column::new("mass ratio", ""), Column::new("energy", "")];
    table(job, "ratio-energy", columns, map)?;
    let points = map.points();
    let points: Vec<[f64; 3]> = points
        .map(|(x, y, grown)| [x, y, grown.rate.value])
        .collect();
    let [x, y, rates] = [0, 1, 2].map(|i| points.iter().map(|p| p[i]).collect::<Vec<f64>>());
    let energy = Axis::linear("energy over that with a horizontal parent");
    let panel = Panel::new(energy).series(Series::shaded(&x, &y, &rates));
    let threshold = 1.0 - THRESHOLD.to_radians().cos();
    let panel = of_the_paper(panel, 1.0, &[0.0, 1.0], &[threshold]);
    let [low, high] = RATIOS;
    let x = Axis::log("mass of the children over that of the paper's").range(low, high);
    let title = "Growth rate of the antiphase mode, released with vertical children";
    draw(job, "ratio-energy", Chart::new(title, x).panel(panel))
}

/// Adds the paper's releases, from one end to the other, and those at its threshold.
fn of_the_paper(panel: Panel, x: f64, ends: &[f64; 2], thresholds: &[f64]) -> Panel {
    let releases = Series::line("the paper's releases", &[x; 2], ends);
    let at = vec![x; thresholds.len()];
    let threshold = Series::points("the paper's threshold", &at, thresholds);
    panel
        .series(releases.color(LINES[2]).dash(Dash::Dashed))
        .series(threshold.color(LINES[2]).symbol(Symbol::Diamond))
}

fn draw(job: &Job, name: &str, chart: Chart) -> Result<(), Failure> {
    let [low, high] = RATES;
    let colors = Axis::log("growth rate (1/s)").range(low, high);
    job.chart(name, &chart.colors(colors).size(960.0, 720.0))
}

fn table(job: &Job, name: &str, [x, y]: [Column; 2], map: &Map) -> Result<(), Failure> {
    let columns = [
        x,
        y,
        Column::new("growth rate", "1/s"),
        Column::new("growth rate between tolerances", ""),
        Column::new("growth factor", ""),
        Column::new("frequency of the difference", "Hz"),
    ];
    job.csv(&format!("{name}.csv"), &columns, |csv| {
        map.points().try_for_each(|(x, y, grown)| {
            let factor = grown
                .factors
                .first()
                .map_or(f64::NAN, |factor| factor.value);
            let (rate, frequency) = (grown.rate, grown.frequency_hz.value);
            let row = [x, y, rate.value, rate.difference, factor, frequency];
            csv.row(row.map(Cell::from))
        })
    })
}

fn summary(map: &Map) -> String {
    let points: Vec<_> = map.points().collect();
    let count = points.len();
    let share = |inside: &dyn Fn(f64) -> bool| {
        let some = points.iter().filter(|(.., grown)| inside(grown.rate.value));
        100.0 * some.count() as f64 / count.max(1) as f64
    };
    let open = points
        .iter()
        .filter(|(.., grown)| !grown.rate.is_determined())
        .count();
    let lost = map.grown.len() - count;
    format!(
        "{count} releases, {:.1} % with a growth rate below {} 1/s, {:.1} % with one above 1 1/s.\n\
         At {open} the two tolerances differ by more than 1 %{}\n",
        share(&|rate| rate < RATES[0]),
        RATES[0],
        share(&|rate| rate > 1.0),
        if lost == 0 {
            ".".to_owned()
        } else {
            format!("; {lost} could not be followed.")
        },
    )
}

/// Ends of the modes, and where differences grow along them.
fn told(modes: &[NormalMode]) -> String {
    let mut text = String::new();
    for mode in modes {
        let Some(last) = mode.orbits.last() else {
            continue;
        };
        let [parent, children] = [0, 1].map(|i| last.release[i].to_degrees());
        let grows = mode
            .floquet
            .iter()
            .filter(|floquet| floquet.rate.value > 1e-4);
        let most = grows
            .clone()
            .map(|floquet| floquet.rate.value)
            .fold(0.0, f64::max);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "Mode f_{}: {:.4} Hz when small, {:.4} Hz at {parent:.1}° and {children:.1}°; differences \
             grow along\n  {} of its {} motions, by {most:.3} 1/s at most",
            mode.sign,
            mode.frequency_hz,
            1.0 / last.period,
            grows.count(),
            mode.orbits.len(),
        );
    }
    text
}

/// The places of largest growth, with their frequencies.
fn list(arguments: &Arguments, tongues: &[Tongue]) -> String {
    if tongues.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "\nTongues of instability at some angles of the parent and at the paper's angle of the\n\
         children, 0°: where differences grow most, over {} s\n  \
         parent                children              rate 1/s  f_eff Hz    f_+ Hz    f_− Hz  resonance\n",
        span(arguments)
    );
    for Tongue { edges, ridge } in tongues {
        let [from, to] = *edges;
        let [plus, minus] = ridge.modes;
        let [parent, children] = [0, 1].map(|i| match ridge.release[i] {
            angle if from[i] == to[i] => format!("{angle}°"),
            angle => format!("{angle}° ({} to {})", from[i], to[i]),
        });
        let resonance = match ridge.resonance {
            None => "-".to_owned(),
            Some(Resonance { numbers, mismatch }) => {
                let tone = CombinationTone {
                    multiples: numbers.to_vec(),
                };
                let sum = tone.named(&["f_+", "f_−"]);
                format!("f_eff − ({sum})/2 = {mismatch:.0e} Hz")
            }
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {parent:20}  {children:20}  {:8.4}  {:8.5}  {plus:8.5}  {minus:8.5}  {resonance}",
            ridge.rate, ridge.effective,
        );
    }
    let first = tongues.iter().filter_map(|tongue| tongue.ridge.resonance);
    let first: Vec<f64> = first
        .filter(|resonance| resonance.numbers == [1, 1])
        .map(|resonance| resonance.mismatch.abs())
        .collect();
    if !first.is_empty() {
        let most = first.iter().copied().fold(0.0, f64::max);
        let _ = writeln!(
            text,
            "In the blades between the modes, at {} places, |f_eff − (f_+ + f_−)/2| is {most:.1e} Hz at \
             most:\ntwice the frequency of the difference is the sum of those of the two modes",
            first.len()
        );
    }
    text
}
