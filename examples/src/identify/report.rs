//! Results in words, as tables and in the record of the run.

use std::fmt::Write;

use branched_pendulum::analysis::identification::ParameterEstimate;
use branched_pendulum_data::Column;
use serde_json::{Map, Value, json};

use super::arguments::Arguments;
use super::scene::Described;
use super::source::Measurement;
use super::study::{Energies, MeasuredEnergy, Mismatch, Outcome, WINDOW};
use crate::failure::Failure;
use crate::program::Job;

/// The report.
pub fn report(
    arguments: &Arguments,
    measurement: &Measurement,
    outcomes: &[Outcome],
    energies: &Energies,
) -> String {
    let mut text = String::new();
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    let times = measurement.record.times();
    match &arguments.measured.file {
        Some(file) => line(format!("{}: {} times", file.display(), times.len())),
        None => line(format!(
            "Simulated: {} times, noise of {} rad",
            times.len(),
            arguments.noise
        )),
    }
    for finding in &measurement.findings {
        line(format!("  {finding}"));
    }
    line(format!(
        "Fitted before {} s, predicted from there on.",
        measurement.until
    ));
    line(String::new());
    line(format!(
        "Angles less data, rms in mrad  in windows of {WINDOW} s   one motion"
    ));
    line(format!(
        "{:<30} {:>8} {:>8} {:>9} {:>8}",
        "friction", "fitted", "later", "fitted", "later"
    ));
    for outcome in outcomes {
        let [fitted, later] = one_motion(measurement, outcome);
        let [first, then] = outcome.windows.each_ref().map(|errors| errors.rms());
        line(format!(
            "{:<30} {:>8.3} {:>8.3} {:>9.3} {:>8.3}",
            outcome.law.name(),
            1e3 * first,
            1e3 * then,
            1e3 * fitted,
            1e3 * later
        ));
    }
    let Some(Outcome { law, fit, .. }) = outcomes.last() else {
        return text;
    };
    line(String::new());
    line(format!(
        "Parameters by one motion, friction {}, SI units:",
        law.name()
    ));
    line(format!(
        "{:<18} {:>13} {:>11} {:>11}{}",
        "",
        "value",
        "deviation",
        "naive",
        if measurement.truth.is_some() {
            "          true"
        } else {
            ""
        }
    ));
    for estimate in &fit.estimates {
        let deviation = |value: Option<f64>| match value {
            Some(value) => format!("{value:>11.1e}"),
            None => format!("{:>11}", "held"),
        };
        let truth = truth(measurement, estimate);
        line(format!(
            "{:<18} {:>13.6e} {} {}{}",
            estimate.name,
            estimate.value,
            deviation(estimate.by_blocks),
            deviation(estimate.naive),
            truth.map_or(String::new(), |truth| format!(" {truth:>13.6e}"))
        ));
    }
    line(format!(
        "Deviations by {} blocks of the record; naive ones take what is left over for white noise.",
        fit.blocks
    ));
    line(String::new());
    line(fit.identifiability.to_string());
    if let Some(error) = &fit.impossible {
        line(format!(
            "No pendulum is such: {error}. What is held, or the law of friction, is not that of \
             the real one; the motion is the same all the same."
        ));
    }
    let compared = |measured: &MeasuredEnergy| {
        let Mismatch {
            rms,
            largest: [largest, time],
            deviation,
        } = energies.mismatch(measured);
        let [rms, largest, deviation] = [rms, largest, deviation].map(|part| 100.0 * part);
        format!(
            "{rms:.2} % (rms), {largest:.2} % at most, at {time:.2} s, where the latter is known \
             to {deviation:.2} %"
        )
    };
    line(format!(
        "Energy of the fitted motion and of the measured one differ, of that at the start,\n  \
         with velocities by the fitted equations by {},\n  \
         with velocities by smoothness alone by {}.",
        compared(&energies.by_equations),
        compared(&energies.by_smoothness)
    ));
    text
}

/// The true value of an estimate, of a simulated record.
fn truth(measurement: &Measurement, estimate: &ParameterEstimate) -> Option<f64> {
    let truth = measurement.truth.as_ref()?;
    let of = truth.iter().find(|(name, _)| *name == estimate.name);
    // Offsets are none.
    Some(of.map_or(0.0, |(_, value)| *value))
}

fn one_motion(measurement: &Measurement, outcome: &Outcome) -> [f64; 2] {
    let errors = &outcome.one_motion;
    [
        errors.rms_between(f64::NEG_INFINITY, measurement.until),
        errors.rms_between(measurement.until, f64::INFINITY),
    ]
}

/// Writes the parameters of the tree, what is left over of each angle, and the energies.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write<M: Described>(
    job: &Job,
    measurement: &Measurement,
    outcome: &Outcome,
    energies: &Energies,
) -> Result<(), Failure> {
    let values = M::PARAMETERS.iter().zip(outcome.fit.parameters());
    let values: Map<String, Value> = values
        .map(|(name, value)| ((*name).to_owned(), json!(value)))
        .collect();
    let table = format!("{:#}\n", Value::Object(values));
    job.write("parameters.json", table.as_bytes())?;
    let mut columns = vec![Column::new("time", "s")];
    for kind in ["window", "one_motion"] {
        let links = measurement.links.iter();
        columns.extend(links.map(|link| Column::new(format!("{kind}_{link}"), "rad")));
    }
    let measured = [&energies.by_equations, &energies.by_smoothness];
    for by in ["equations", "smoothness"] {
        columns.push(Column::new(format!("energy_by_{by}"), "J"));
        columns.push(Column::new(format!("energy_by_{by}_error"), "J"));
    }
    columns.push(Column::new("fitted_energy", "J"));
    let [fitted, later] = &outcome.windows;
    let windows = fitted.rows.iter().chain(&later.rows);
    job.csv("errors.csv", &columns, |file| {
        let rows = windows.zip(&outcome.one_motion.rows);
        for (index, (window, one)) in rows.enumerate() {
            let mut row = vec![energies.times[index]];
            row.extend(
                window
                    .iter()
                    .chain(one)
                    .map(|error| error.unwrap_or(f64::NAN)),
            );
            for energy in measured {
                row.extend([energy.values[index], energy.deviations[index]]);
            }
            row.push(energies.fitted[index]);
            file.row(row)?;
        }
        Ok(())
    })
}

/// Puts what was found into the record of the run.
pub fn record(job: &Job, measurement: &Measurement, outcomes: &[Outcome], energies: &Energies) {
    for outcome in outcomes {
        let parameters = outcome.fit.estimates.iter().map(|estimate| {
            json!({
                "name": estimate.name,
                "value": estimate.value,
                "deviation": estimate.by_blocks,
                "naive": estimate.naive,
            })
        });
        let found = json!({
            "parameters": parameters.collect::<Vec<_>>(),
            "determined": outcome.fit.identifiability.determined(),
            "windows": outcome.windows.each_ref().map(|errors| errors.rms()),
            "one_motion": one_motion(measurement, outcome),
        });
        job.report(outcome.law.name(), found);
    }
    let findings = measurement.findings.iter().map(ToString::to_string);
    job.report("findings", findings.collect::<Vec<_>>());
    for (name, measured) in [
        ("energy_mismatch", &energies.by_equations),
        ("energy_mismatch_by_smoothness", &energies.by_smoothness),
    ] {
        let Mismatch {
            rms,
            largest,
            deviation,
        } = energies.mismatch(measured);
        let found = json!({"rms": rms, "largest": largest, "deviation": deviation});
        job.report(name, found);
    }
}
