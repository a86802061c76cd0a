//! Words, table and chart of a map.

use std::fmt::Write;

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, Symbol};
use branched_pendulum_data::{Cell, Column};

use super::arguments::{Arguments, Scene};
use super::blades::Ridge;
use super::map::Map;
use super::normal_modes::NormalMode;
use crate::critical_angle::scan::PAPER;
use crate::failure::Failure;
use crate::program::Job;

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
    ridges: &[Ridge],
) -> Result<(), Failure> {
    if map.is_empty() {
        return Ok(());
    }
    let title = match arguments.scene {
        Scene::Paper => "Growth rate of the antiphase mode after a release from rest",
        Scene::Arms => "Growth rate of a difference between two jointed arms, released from rest",
    };
    job.print(&format!("{}{}{}", summary(map), told(modes), list(ridges)))?;
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
            let middle = 0.5 * (PAPER[0] + PAPER[1]);
            let line = [-arguments.parent, arguments.parent];
            let threshold = Series::points("the paper's threshold", &[0.0; 2], &[-middle, middle]);
            panel
                .series(
                    Series::line("the paper's releases", &[0.0; 2], &line)
                        .color(LINES[2])
                        .dash(Dash::Dashed),
                )
                .series(threshold.color(LINES[2]).symbol(Symbol::Diamond))
        }
        Scene::Arms => panel,
    };
    let x = Axis::linear("common angle of the children (°)");
    let chart = Chart::new(title, x.range(-arguments.children, arguments.children));
    draw(job, "release-map", chart.panel(panel))
}

/// Colours of lines that are seen on dark blue and on yellow.
const LINES: [Color; 3] = [
    Color::rgb(225, 70, 60),
    Color::rgb(70, 200, 245),
    Color::rgb(245, 245, 245),
];

/// Prints, writes and draws the plane of ratio and energy.
///
/// # Errors
/// [`Failure`].
pub fn ratios(arguments: &Arguments, job: &Job, map: &Map) -> Result<(), Failure> {
    let _ = arguments;
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
    let panel = Panel::new(Axis::linear("energy over that with a horizontal parent"))
        .series(Series::shaded(&x, &y, &rates))
        .vertical(1.0, "the paper's children");
    let x = Axis::log("mass of the children over that of the paper's");
    let title = "Growth rate of the antiphase mode, released with vertical children";
    draw(job, "ratio-energy", Chart::new(title, x).panel(panel))
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
fn list(ridges: &[Ridge]) -> String {
    if ridges.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "\nLargest growth across the tongues, frequencies over 120 s\n  \
         parent  children   rate 1/s     f_eff Hz     f_+ Hz     f_− Hz   f_eff − (f_+ + f_−)/2\n",
    );
    for ridge in ridges {
        let [parent, children] = ridge.release;
        let [plus, minus] = ridge.modes;
        let known = ridge.effective.is_determined() && ridge.rate.is_determined();
        let _ = writeln!(
            text,
            "  {parent:5.1}°  {children:7.2}°  {:9.4}  {:11.5}  {plus:9.5}  {minus:9.5}  {:12.5}{}",
            ridge.rate.value,
            ridge.effective.value,
            ridge.mismatch(),
            if known { "" } else { " ?" }
        );
    }
    text
}
