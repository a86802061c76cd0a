//! Charts of the errors of the identified model, and of the energy, against time.

use branched_pendulum_charts::{Axis, Chart, Color, Dash, Panel, Series, verbatim};
use branched_pendulum_measure::identification::AngleErrors;

use super::source::Measurement;
use super::study::{Energies, Outcome};

const BLACK: Color = Color::rgb(0, 0, 0);

/// Draws the errors of the reported law, in windows and over one motion (compared with the first
/// law), and the energies.
pub fn chart(
    measurement: &Measurement,
    outcomes: &[Outcome],
    reported: &Outcome,
    energies: Option<&Energies>,
) -> Chart {
    let title = "Measured motion and the identified model";
    let chart = Chart::new(title, Axis::linear("t (s)")).size(1000.0, 900.0);
    let mut panels: Vec<Panel> = Vec::new();
    let [fitted, later] = &reported.windows;
    let joined = AngleErrors {
        times: [fitted.times.as_slice(), &later.times].concat(),
        rows: [fitted.rows.as_slice(), &later.rows].concat(),
        ..fitted.clone()
    };
    let mut panel = |axis: String, left_over: &AngleErrors| {
        let panel = errors(Panel::new(Axis::linear(axis)), left_over);
        panels.push(marked(panel, measurement));
    };
    let window = reported.window();
    panel(
        format!("residuals in windows of {window} s (mrad)"),
        &joined,
    );
    if let Some(left_over) = &reported.errors {
        panel("residuals of one motion (mrad)".to_owned(), left_over);
    }
    if let Some(first) = outcomes.first().filter(|first| first.law != reported.law)
        && let Some(left_over) = &first.errors
    {
        let law = first.law.name();
        panel(format!("residuals of one motion, {law} (mrad)"), left_over);
    }
    let chart = panels.into_iter().fold(chart, Chart::panel);
    let Some(energies) = energies else {
        return chart;
    };
    let energy = Panel::new(Axis::linear("energy (J)"))
        .series(
            Series::line("measured", &energies.times, &energies.by_equations.values)
                .color(Color::of_series(1))
                .dash(Dash::Solid),
        )
        .series(
            Series::line("fitted", &energies.times, &energies.fitted)
                .color(BLACK)
                .dash(Dash::Dashed),
        );
    chart.panel(marked(energy, measurement))
}

fn errors(panel: Panel, errors: &AngleErrors) -> Panel {
    let links = errors.links.iter().enumerate();
    let panel = links.fold(panel, |panel, (index, link)| {
        let error = |row: &Vec<Option<f64>>| 1e3 * row[index].unwrap_or(f64::NAN);
        let values: Vec<f64> = errors.rows.iter().map(error).collect();
        panel.series(
            Series::line(verbatim(link), &errors.times, &values)
                .color(Color::of_series(index))
                .dash(Dash::Solid),
        )
    });
    panel.zero_line()
}

fn marked(panel: Panel, measurement: &Measurement) -> Panel {
    panel.vertical(measurement.until, "predicted")
}
