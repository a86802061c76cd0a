//! Result of a fit as text, as tables and as `parameters.json`.

use std::fmt::Write;

use branched_pendulum_data::{Cell, Column};
use branched_pendulum_measure::identification::{DIVIDED, Fit, ParameterEstimate, Standing, TIMES};
use serde_json::{Value, json};

use super::unknowns::{Parameter, Unknowns};
use crate::Failure;
use crate::constants::KnownConstants;
use crate::frame::Job;

/// Share in an undetermined combination from which on it is worth measuring a parameter separately.
const WORTH: f64 = 0.1;

/// Writes the table of the estimates: first the values that the data determine, then values that
/// depend on fixed ones; with the true values if the record is simulated.
pub fn table(fit: &Fit, truths: Option<&[(String, f64)]>) -> String {
    // Of frequencies alone there is one deviation.
    let has_blocks = !fit.starts.is_empty();
    let naive = if has_blocks { "naive" } else { "" };
    let truth = if truths.is_some() {
        "         true"
    } else {
        ""
    };
    let heading = format!(
        "{:<34} {:>13} {:>11} {naive:>11} {truth}",
        "", "value", "deviation"
    );
    let mut lines = vec![heading.trim_end().to_owned()];
    let rank = |estimate: &&ParameterEstimate| match estimate.standing {
        Standing::Determined => 0,
        Standing::AtBound => 1,
        Standing::GoesWith(_) => 2,
        Standing::Held => 3,
    };
    let mut rows: Vec<&ParameterEstimate> = fit.estimates.iter().chain(&fit.ratios).collect();
    rows.sort_by_key(rank);
    for estimate in rows {
        let deviation = |value: Option<f64>| match value {
            // An error bar of a value that hangs on another is none of its error.
            Some(value) if estimate.standing == Standing::Determined => format!("{value:.1e}"),
            _ => String::new(),
        };
        let mark = match &estimate.standing {
            Standing::Determined => String::new(),
            Standing::AtBound => "  at its bound".to_owned(),
            Standing::GoesWith(held) => format!("  goes with {}", held.join(", ")),
            Standing::Held => "  held, left open by the data".to_owned(),
        };
        let naive = estimate.naive.filter(|_| has_blocks);
        let truth = truths.and_then(|truths| truth_of(truths, &estimate.name));
        let row = format!(
            "{:<34} {:>13.6e} {:>11} {:>11} {}{mark}",
            estimate.name,
            estimate.value,
            deviation(estimate.deviation()),
            deviation(naive),
            truth.map_or(String::new(), |truth| format!("{truth:>13.6e}"))
        );
        lines.push(row.trim_end().to_owned());
    }
    lines.join("\n") + "\n"
}

/// Returns the true value of an unknown or of a ratio.
fn truth_of(truths: &[(String, f64)], name: &str) -> Option<f64> {
    let of = |factor: &str| {
        let own = truths.iter().find(|(name, _)| *name == factor);
        // Offsets are none.
        own.map_or(0.0, |(_, value)| *value)
    };
    let mut divided = name.split(DIVIDED);
    let product: f64 = divided.next()?.split(TIMES).map(of).product();
    Some(divided.fold(product, |value, divisor| value / of(divisor)))
}

/// Lists what the data do not determine and what should be measured for it, and negative friction
/// coefficients.
pub fn standing(unknowns: &Unknowns, fit: &Fit) -> String {
    let mut text = format!("\n{}\n", fit.identifiability);
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    for open in &fit.identifiability.open {
        let own = open
            .others
            .iter()
            .filter(|(_, change)| change.abs() > WORTH);
        let names = own.map(|(name, _)| name).chain([&open.held]);
        let is_measurable = |name: &&String| {
            let own = unknowns.parameter(name);
            own.is_some_and(Parameter::is_measurable)
        };
        let names: Vec<&str> = names.filter(is_measurable).map(String::as_str).collect();
        if !names.is_empty() {
            line(format!(
                "  for {}: weigh or measure {}, and give it by --set",
                open.held,
                names.join(" or ")
            ));
        }
    }
    if let Some(error) = &fit.impossible
        && fit.driving_friction().is_none()
    {
        line(format!("Zero within its error bar: {error}."));
    }
    text
}

/// Writes the table of the measured frequencies; empty if none were measured.
pub fn frequencies(fit: &Fit) -> String {
    if fit.frequencies.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "Frequencies (Hz), and by how many errors the model is above them:\n\
         {:>6} {:>12} {:>12} {:>12} {:>8}\n",
        "mode", "measured", "error", "model", "above"
    );
    for own in &fit.frequencies {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:>6} {:>12.6} {:>12.6} {:>12.6} {:>8.2}",
            own.mode,
            own.hertz,
            own.deviation,
            own.fitted,
            own.residual()
        );
    }
    text
}

/// Writes `frequencies.csv` if frequencies were measured.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write_frequencies(job: &Job, fit: &Fit) -> Result<(), Failure> {
    if fit.frequencies.is_empty() {
        return Ok(());
    }
    let columns = [
        Column::new("mode", ""),
        Column::new("measured", "Hz"),
        Column::new("error", "Hz"),
        Column::new("model", "Hz"),
    ];
    job.csv("frequencies.csv", &columns, |file| {
        fit.frequencies.iter().try_for_each(|own| {
            let values = [own.hertz, own.deviation, own.fitted].map(Cell::from);
            file.row([Cell::Count(own.mode as u64)].into_iter().chain(values))
        })
    })
}

/// Returns the measured frequencies for the record of the run.
pub fn recorded_frequencies(fit: &Fit) -> Value {
    let each = fit.frequencies.iter().map(|own| {
        json!({
            "mode": own.mode,
            "measured": own.hertz,
            "error": own.deviation,
            "model": own.fitted,
        })
    });
    each.collect()
}

/// Writes the values of all parameters and the offsets of the links' angles (rad) to
/// `parameters.json` and to the record of the run.
///
/// # Errors
/// [`Failure::File`].
pub fn write_parameters(
    job: &Job,
    unknowns: &Unknowns,
    fit: &Fit,
    offsets: Vec<(String, f64)>,
) -> Result<(), Failure> {
    let values = unknowns.parameters.iter().zip(fit.parameters());
    let found = KnownConstants {
        values: values
            .map(|(own, value)| (own.name.clone(), *value))
            .collect(),
        offsets,
    };
    let table = found.table();
    job.report("parameters", table.clone());
    let table = format!("{:#}\n", Value::Object(table));
    job.write("parameters.json", table.as_bytes())
}
