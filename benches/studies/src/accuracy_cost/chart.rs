//! Chart of accuracy against cost of all models, methods and scalar types, with the most efficient
//! runs and the advisor's choices.

use std::collections::BTreeMap;

use branched_pendulum_advice::{Advice, CandidateName, Measured, pareto};
use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, Symbol};
use branched_pendulum_data::{Cell, Column};

use super::requests::{self, OutputName, Question, SceneName};
use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Largest errors of the angles (rad) for which the advisor is asked.
const TOLERANCES: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// Duration of the motions in s, and samples a second.
const HORIZON: f64 = 3.0;
const RATE: f64 = 10.0;

/// Distance between two tolerances of a method, in decades.
const SPACING: f64 = 0.5;

/// Measurements of a scene.
struct Surveyed {
    scene: SceneName,
    names: Vec<CandidateName>,
    runs: Vec<Measured>,
    advice: Vec<Advice>,
}

/// Measures the three scenes, and writes the chart and its table.
///
/// # Errors
/// [`Failure`].
pub fn draw(job: &Job) -> Result<(), Failure> {
    let progress = job.progress(SceneName::ALL.len());
    let mut all = Vec::new();
    for scene in SceneName::ALL {
        progress.begin(scene.title());
        let surveyed = progress.ticking(|| survey(scene))?;
        job.print(&table(&surveyed))?;
        all.push(surveyed);
        progress.next();
    }
    write(job, &all)?;
    job.chart("accuracy-cost", &chart(&all))
}

fn survey(scene: SceneName) -> Result<Surveyed, Failure> {
    let question = |tolerance| Question {
        scene,
        output: OutputName::Angles,
        tolerance,
        horizon: HORIZON,
        rate: RATE,
        starts: 1,
    };
    let advice: Result<Vec<Advice>, Failure> = TOLERANCES
        .into_iter()
        .map(|tolerance| {
            requests::with(&question(tolerance), |advisor, candidates| {
                advisor.advise(candidates)
            })
        })
        .collect();
    let advice = advice?;
    // Errors are relative to an allowed error of 1 rad. The finest choice is not the most expensive
    // point of the chart.
    let dearest = advice.iter().filter_map(Advice::chosen);
    let most = 5.0 * dearest.map(|run| run.seconds).fold(0.0, f64::max);
    let (names, runs) = requests::with(&question(1.0), |advisor, candidates| {
        let names = candidates.names().collect();
        Ok((names, advisor.survey(candidates, SPACING, most)?))
    })?;
    Ok(Surveyed {
        scene,
        names,
        runs,
        advice,
    })
}

/// Returns the choices in a scene as text.
fn table(surveyed: &Surveyed) -> String {
    let mut text = format!("{}\n", surveyed.scene.title());
    for (tolerance, advice) in TOLERANCES.iter().zip(&surveyed.advice) {
        let line = match advice.chosen() {
            Some(run) => {
                let share = advice
                    .runner_up()
                    .map_or(f64::NAN, |other| other.seconds / run.seconds);
                format!(
                    "{:8.1} µs  {} (the next {share:.2} times)",
                    1e6 * run.seconds,
                    advice.describe(run)
                )
            }
            None => "nothing".to_owned(),
        };
        text += &format!("  {tolerance:>6e} rad  {line}\n");
    }
    text + "\n"
}

/// Returns the name of the series to which a candidate belongs: its model and scalar type.
fn series_of(name: &CandidateName) -> String {
    format!("{}, {}", name.model, name.scalar)
}

fn write(job: &Job, all: &[Surveyed]) -> Result<(), Failure> {
    let columns = [
        Column::new("scene", ""),
        Column::new("model", ""),
        Column::new("method", ""),
        Column::new("scalar", ""),
        Column::new("tolerance or step", ""),
        Column::new("largest error of an angle", "rad"),
        Column::new("time", "s"),
        Column::new("on the front", ""),
    ];
    job.csv("accuracy-cost.csv", &columns, |csv| {
        for surveyed in all {
            let front = pareto(&surveyed.runs);
            for (index, run) in surveyed.runs.iter().enumerate() {
                let name = &surveyed.names[run.candidate];
                csv.row([
                    Cell::from(surveyed.scene.title()),
                    name.model.as_str().into(),
                    name.method.as_str().into(),
                    name.scalar.into(),
                    run.setting.into(),
                    run.ratio().into(),
                    run.seconds.into(),
                    if front.contains(&index) { "yes" } else { "no" }.into(),
                ])?;
            }
        }
        Ok(())
    })
}

/// Colours of the models, in the order of their names.
const COLOURS: [Color; 6] = [
    Color::rgb(0, 114, 178),
    Color::rgb(213, 94, 0),
    Color::rgb(0, 158, 115),
    Color::rgb(204, 121, 167),
    Color::rgb(230, 159, 0),
    Color::rgb(86, 180, 233),
];

fn chart(all: &[Surveyed]) -> Chart {
    let title = format!("Largest error of an angle in {HORIZON} s against the time that it takes");
    let names = || all.iter().flat_map(|surveyed| &surveyed.names);
    let mut models: Vec<&str> = names().map(|name| name.model.as_str()).collect();
    models.sort_unstable();
    models.dedup();
    let look = |name: &CandidateName| {
        let model = models.iter().position(|model| *model == name.model);
        let symbol = match name.scalar {
            "f32" => Symbol::Triangle,
            _ => Symbol::Circle,
        };
        (COLOURS[model.unwrap_or(0) % COLOURS.len()], symbol)
    };
    let chart = Chart::new(title, Axis::log("time (µs)"))
        .columns(all.len())
        .size(1500.0, 640.0);
    all.iter().fold(chart, |chart, surveyed| {
        let axis = Axis::log(format!("error (rad), {}", surveyed.scene.title()));
        let mut panel = Panel::new(axis.range(1e-14, 10.0));
        let names = surveyed.names.iter();
        let looks: BTreeMap<String, (Color, Symbol)> =
            names.map(|name| (series_of(name), look(name))).collect();
        let point = |run: &Measured| (1e6 * run.seconds, run.ratio());
        for (label, (color, symbol)) in looks {
            let own = surveyed.runs.iter().filter(|run| {
                run.ratio().is_finite() && series_of(&surveyed.names[run.candidate]) == label
            });
            let (x, y): (Vec<f64>, Vec<f64>) = own.map(point).unzip();
            let points = Series::points(label, &x, &y);
            panel = panel.series(points.color(color).symbol(symbol));
        }
        let front = pareto(&surveyed.runs).into_iter();
        let (x, y): (Vec<f64>, Vec<f64>) = front.map(|index| point(&surveyed.runs[index])).unzip();
        let black = Color::rgb(0, 0, 0);
        panel = panel.series(
            Series::line("the front", &x, &y)
                .color(black)
                .dash(Dash::Solid),
        );
        let chosen = surveyed.advice.iter().filter_map(Advice::chosen);
        let (x, y): (Vec<f64>, Vec<f64>) = chosen
            .map(|run| {
                let error = run.worst.as_ref().map_or(f64::NAN, |worst| worst.error);
                (1e6 * run.seconds, error)
            })
            .unzip();
        chart.panel(
            panel.series(
                Series::points("the advisor's choices", &x, &y)
                    .color(black)
                    .symbol(Symbol::Cross),
            ),
        )
    })
}
