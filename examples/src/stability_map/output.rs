//! Maps, CSV file and charts.

use std::path::{Path, PathBuf};

use branched_pendulum::data::{Column, CsvWriter};
use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series, Symbol};

use super::verdict::{DAMPED_ANGLE, Verdict, damped, damped_model, damped_reference, ideal};
use crate::branched_double::Failure;
use crate::solvers::legend;

/// Methods that take a step.
pub const FIXED: [Method; 5] = [
    Method::Rk4,
    Method::Gauss(GaussOrder::Two),
    Method::Gauss(GaussOrder::Four),
    Method::Gauss(GaussOrder::Eight),
    Method::Animation,
];

/// Methods that take a tolerance.
pub const ADAPTIVE: [Method; 4] = [
    Method::Dopri5,
    Method::Dop853,
    Method::Verner98,
    Method::Taylor,
];

/// A run's place in its map, and what became of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The method.
    pub method: Method,
    /// Its step or tolerance.
    pub setting: f64,
    /// Angle of release (degrees) or friction (N m s).
    pub height: f64,
    /// What became of the run.
    pub verdict: Verdict,
}

/// A map: its file name, title, axes, methods and places.
#[derive(Clone, Debug)]
pub struct Map {
    name: &'static str,
    title: String,
    x: &'static str,
    height: &'static str,
    /// The y axis of a method's panel.
    y: fn(&str) -> Axis,
    /// The methods, in the order of the panels.
    pub methods: Vec<Method>,
    /// The runs.
    pub places: Vec<Place>,
}

fn logarithmic(low: f64, high: f64, count: u32) -> Vec<f64> {
    let ratio = |k| f64::from(k) / f64::from(count - 1);
    (0..count)
        .map(|k| low * (high / low).powf(ratio(k)))
        .collect()
}

/// Computes all maps, on all cores.
///
/// # Errors
/// [`Failure`]: the reference with friction could not be computed.
pub fn maps() -> Result<Vec<Map>, Failure> {
    let angles: Vec<f64> = (1..=11).map(|k| 15.0 * f64::from(k)).collect();
    let steps = logarithmic(1e-3, 0.3, 16);
    let tolerances = logarithmic(1e-12, 1e-1, 12);
    let frictions = logarithmic(1e-5, 10.0, 13);
    let by_angle = |methods: &[Method], settings: &[f64]| {
        let grid = grid(methods, settings, &angles);
        Ensemble::new().map(&grid, |_, &(method, setting, height)| Place {
            method,
            setting,
            height,
            verdict: ideal(method, setting, height),
        })
    };
    let references = frictions
        .iter()
        .map(|&friction| {
            let model = damped_model(friction)?;
            let energy = damped_reference(&model).map_err(|error| Failure::Integration {
                angle_deg: DAMPED_ANGLE,
                source: error.to_string().into(),
            })?;
            Ok((friction, model, energy))
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    let by_friction = grid(&FIXED, &steps, &frictions);
    let by_friction = Ensemble::new().map(&by_friction, |_, &(method, setting, height)| {
        let reference = references.iter().find(|reference| reference.0 == height);
        let verdict = reference.map(|(_, model, energy)| damped(method, setting, model, *energy));
        Place {
            method,
            setting,
            height,
            verdict: verdict.unwrap_or(Verdict::Refused),
        }
    });
    let release = |method: &str| Axis::linear(format!("{method}: θ_1(0) (°)")).range(0.0, 180.0);
    Ok(vec![
        Map {
            name: "stability-amplitude",
            title: "100 s without friction: step against amplitude".to_owned(),
            x: "step (s)",
            height: "release (degrees)",
            y: release,
            methods: FIXED.to_vec(),
            places: by_angle(&FIXED, &steps),
        },
        Map {
            name: "stability-tolerance",
            title: "100 s without friction: tolerance against amplitude".to_owned(),
            x: "tolerance",
            height: "release (degrees)",
            y: release,
            methods: ADAPTIVE.to_vec(),
            places: by_angle(&ADAPTIVE, &tolerances),
        },
        Map {
            name: "stability-friction",
            title: format!("3 s from {DAMPED_ANGLE}° with friction in every pivot"),
            x: "step (s)",
            height: "friction (N m s)",
            y: |method| Axis::log(format!("{method}: c (N m s)")).range(5e-6, 20.0),
            methods: FIXED.to_vec(),
            places: by_friction,
        },
    ])
}

fn grid(methods: &[Method], settings: &[f64], heights: &[f64]) -> Vec<(Method, f64, f64)> {
    let mut grid = Vec::new();
    for &method in methods {
        for &setting in settings {
            grid.extend(heights.iter().map(|&height| (method, setting, height)));
        }
    }
    grid
}

/// How many runs of each method came to what.
pub fn table(maps: &[Map]) -> String {
    let mut text = String::new();
    for map in maps {
        text.push_str(&format!("{}\n\n{:24}", map.title, ""));
        for verdict in Verdict::ALL {
            text.push_str(&format!("{:>18}", verdict.name()));
        }
        text.push('\n');
        for method in &map.methods {
            text.push_str(&format!("{:24}", method.title()));
            for verdict in Verdict::ALL {
                let own = map.places.iter().filter(|place| place.method == *method);
                let count = own.filter(|place| place.verdict == verdict).count();
                text.push_str(&format!("{count:>18}"));
            }
            text.push('\n');
        }
        text.push('\n');
    }
    text
}

/// Writes CSV files and charts, and returns the files.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::Chart`].
pub fn write(folder: &Path, maps: &[Map]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for map in maps {
        let file = |extension: &str| folder.join(format!("{}.{extension}", map.name));
        let (csv, svg, png) = (file("csv"), file("svg"), file("png"));
        let verdicts = Verdict::ALL.iter().enumerate();
        let verdicts: Vec<_> = verdicts
            .map(|(index, verdict)| format!("{index} {}", verdict.name()))
            .collect();
        let columns = [
            legend(&map.methods),
            map.x.to_owned(),
            map.height.to_owned(),
            format!("verdict: {}", verdicts.join("; ")),
        ];
        let mut writer = CsvWriter::create(&csv, &columns.map(|name| Column::new(name, "")))?;
        for place in &map.places {
            let method = map
                .methods
                .iter()
                .position(|method| *method == place.method);
            let verdict = Verdict::ALL
                .iter()
                .position(|verdict| *verdict == place.verdict);
            let number = |index: Option<usize>| index.map_or(f64::NAN, |index| index as f64);
            writer.row(&[number(method), place.setting, place.height, number(verdict)])?;
        }
        writer.finish()?;
        let chart = chart(map);
        chart.write_svg(&svg)?;
        chart.write_png(&png)?;
        files.extend([csv, svg, png]);
    }
    Ok(files)
}

fn chart(map: &Map) -> Chart {
    let styles = [
        (Color::rgb(0x1b, 0x7a, 0x3d), Symbol::Circle),
        (Color::rgb(0x2b, 0x6c, 0xb8), Symbol::Square),
        (Color::rgb(0xd9, 0x8a, 0x00), Symbol::Triangle),
        (Color::rgb(0xc0, 0x2a, 0x2a), Symbol::Cross),
        (Color::rgb(0x80, 0x80, 0x80), Symbol::Plus),
    ];
    let height = 120.0 + 190.0 * map.methods.len() as f64;
    let chart = Chart::new(&map.title, Axis::log(map.x)).size(900.0, height);
    map.methods.iter().fold(chart, |chart, method| {
        let panel = Panel::new((map.y)(method.title()));
        let panel = Verdict::ALL
            .iter()
            .zip(styles)
            .fold(panel, |panel, (verdict, style)| {
                let own = map.places.iter();
                let own = own.filter(|place| place.method == *method && place.verdict == *verdict);
                let (x, y): (Vec<f64>, Vec<f64>) =
                    own.map(|place| (place.setting, place.height)).unzip();
                if x.is_empty() {
                    return panel;
                }
                let series = Series::points(verdict.name(), &x, &y);
                panel.series(series.color(style.0).symbol(style.1))
            });
        chart.panel(panel)
    })
}
