//! Maps, CSV file and charts.

use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Color, Panel, Series};
use branched_pendulum_data::{Cell, Column};

use super::verdict::{DAMPED_ANGLE, Verdict, damped, damped_model, damped_reference, ideal};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

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

/// A run of a map, and its result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// The method.
    pub method: Method,
    /// Step or tolerance of the method.
    pub setting: f64,
    /// Angle of release (degrees) or friction coefficient (N m s).
    pub height: f64,
    /// The run's fate.
    pub verdict: Verdict,
}

/// A map: a survey with its results.
#[derive(Clone, Debug)]
pub struct Map {
    survey: Survey,
    /// The runs.
    pub trials: Vec<Trial>,
}

/// Set of runs that make up a map.
#[derive(Clone, Copy, Debug)]
pub struct Survey {
    /// Name on the command line.
    pub name: &'static str,
    /// Title of the panels.
    pub title: &'static str,
    /// Names and units of the two coordinates: setting, and angle or friction.
    columns: [(&'static str, &'static str); 2],
    /// The y axis of a method's panel.
    y: fn(&str) -> Axis,
    methods: &'static [Method],
    settings: fn() -> Vec<f64>,
    heights: fn() -> Vec<f64>,
    judge: fn(&[f64]) -> Result<Judge, Failure>,
}

/// Function that runs a method with this setting and this angle or friction, and returns the
/// verdict.
type Judge = Box<dyn Fn(Method, f64, f64) -> Verdict + Sync>;

/// All surveys.
pub const SURVEYS: [Survey; 3] = [
    Survey {
        name: "amplitude",
        title: "100 s without friction: step against amplitude",
        columns: [("step", "s"), ("release", "degrees")],
        y: release_axis,
        methods: &FIXED,
        settings: steps,
        heights: releases,
        judge: |_| Ok(Box::new(ideal)),
    },
    Survey {
        name: "tolerance",
        title: "100 s without friction: tolerance against amplitude",
        columns: [("tolerance", ""), ("release", "degrees")],
        y: release_axis,
        methods: &ADAPTIVE,
        settings: || logarithmic(1e-12, 1e-1, 12),
        heights: releases,
        judge: |_| Ok(Box::new(ideal)),
    },
    Survey {
        name: "friction",
        title: "3 s from 40° with friction in every pivot",
        columns: [("step", "s"), ("friction", "N m s")],
        y: |method| Axis::log(format!("{method}: c (N m s)")),
        methods: &FIXED,
        settings: steps,
        heights: || logarithmic(1e-5, 10.0, 13),
        judge: damped_by_friction,
    },
];

fn release_axis(method: &str) -> Axis {
    Axis::linear(format!("{method}: θ_1(0) (°)"))
}

fn releases() -> Vec<f64> {
    (1..=11).map(|k| 15.0 * f64::from(k)).collect()
}

fn steps() -> Vec<f64> {
    logarithmic(1e-3, 0.3, 16)
}

fn logarithmic(low: f64, high: f64, count: u32) -> Vec<f64> {
    let ratio = |k| f64::from(k) / f64::from(count - 1);
    (0..count)
        .map(|k| low * (high / low).powf(ratio(k)))
        .collect()
}

/// Computes the reference energies for all friction coefficients, before the runs.
fn damped_by_friction(frictions: &[f64]) -> Result<Judge, Failure> {
    let reference = |&friction: &f64| {
        let model = damped_model(friction)?;
        let energy =
            damped_reference(&model).map_err(|error| Failure::integration(DAMPED_ANGLE, error))?;
        Ok((friction, model, energy))
    };
    let references = frictions.iter().map(reference);
    let references = references.collect::<Result<Vec<_>, Failure>>()?;
    Ok(Box::new(move |method, setting, friction| {
        let reference = references.iter().find(|(own, ..)| *own == friction);
        let verdict = reference.map(|(_, model, energy)| damped(method, setting, model, *energy));
        verdict.unwrap_or(Verdict::Refused)
    }))
}

impl Survey {
    /// Runs the survey, on all cores.
    ///
    /// # Errors
    /// [`Failure`]: the reference with friction could not be computed.
    pub fn map(self, job: &Job) -> Result<Map, Failure> {
        let heights = (self.heights)();
        let grid = grid(self.methods, &(self.settings)(), &heights);
        let progress = job.progress(grid.len());
        progress.begin(self.name);
        let judge = (self.judge)(&heights)?;
        let trials = Ensemble::new().map(&grid, |_, &(method, setting, height)| {
            let verdict = judge(method, setting, height);
            progress.next();
            Trial {
                method,
                setting,
                height,
                verdict,
            }
        });
        let survey = self;
        Ok(Map { survey, trials })
    }
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

/// Returns the table of a map: for each method, the number of runs with each verdict.
pub fn table(map: &Map) -> String {
    let mut text = format!("{}\n\n{:24}", map.survey.title, "");
    for verdict in Verdict::ALL {
        text += &format!("{:>18}", verdict.name());
    }
    text.push('\n');
    for method in map.survey.methods {
        text += &format!("{:24}", method.title());
        for verdict in Verdict::ALL {
            let own = map.trials.iter().filter(|trial| trial.method == *method);
            let count = own.filter(|trial| trial.verdict == verdict).count();
            text += &format!("{count:>18}");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// Prints the table of a map, and writes its CSV file and chart.
///
/// # Errors
/// [`Failure`].
pub fn deliver(job: &Job, map: &Map) -> Result<(), Failure> {
    let [x, height] = map
        .survey
        .columns
        .map(|(name, unit)| Column::new(name, unit));
    let columns = [
        Column::new("method", ""),
        x,
        height,
        Column::new("verdict", ""),
    ];
    let name = format!("stability-{}", map.survey.name);
    job.csv(&format!("{name}.csv"), &columns, |csv| {
        map.trials.iter().try_for_each(|trial| {
            csv.row([
                Cell::from(trial.method.title()),
                trial.setting.into(),
                trial.height.into(),
                trial.verdict.name().into(),
            ])
        })
    })?;
    job.chart(&name, &chart(map))?;
    job.print(&table(map))
}

fn chart(map: &Map) -> Chart {
    let colors = [
        Color::rgb(0x1b, 0x7a, 0x3d),
        Color::rgb(0x56, 0xb4, 0xe9),
        Color::rgb(0xe6, 0x9f, 0x00),
        Color::rgb(0xc0, 0x2a, 0x2a),
        Color::rgb(0xb0, 0xb0, 0xb0),
    ];
    let Survey {
        title,
        columns: [(x, unit), _],
        y,
        methods,
        ..
    } = map.survey;
    let x = match unit {
        "" => x.to_owned(),
        _ => format!("{x} ({unit})"),
    };
    let rows = methods.len().div_ceil(2);
    let chart = Chart::new(title, Axis::log(x))
        .columns(2)
        .size(1000.0, 120.0 + 240.0 * rows as f64);
    methods.iter().fold(chart, |chart, method| {
        let panel = Panel::new(y(method.title()));
        let verdicts = Verdict::ALL.iter().zip(colors);
        let panel = verdicts.fold(panel, |panel, (verdict, color)| {
            let own = map.trials.iter();
            let own = own.filter(|trial| trial.method == *method && trial.verdict == *verdict);
            let (x, y): (Vec<f64>, Vec<f64>) =
                own.map(|trial| (trial.setting, trial.height)).unzip();
            match x.as_slice() {
                [] => panel,
                _ => panel.series(Series::cells(verdict.name(), &x, &y).color(color)),
            }
        });
        chart.panel(panel)
    })
}
