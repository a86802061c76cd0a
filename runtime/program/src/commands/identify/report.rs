//! Results as text, as tables and in the record of the run.

use std::fmt::Write;

use branched_pendulum_data::Column;
use branched_pendulum_measure::identification::{SearchOutcome, Standing, best};
use serde_json::{Value, json};

use super::arguments::Arguments;
use super::estimates;
use super::source::Measurement;
use super::study::{Energies, MeasuredEnergy, Mismatch, Outcome};
use super::unknowns::Unknowns;
use crate::Failure;
use crate::frame::Job;

/// The report.
pub fn report(
    arguments: &Arguments,
    unknowns: &Unknowns,
    measurement: &Measurement,
    outcomes: &[Outcome],
    reported: &Outcome,
    energies: Option<&Energies>,
) -> String {
    let mut text = no_fit(reported);
    text += &measured(arguments, measurement);
    text += &errors_by_law(measurement, outcomes);
    text.push('\n');
    text += &convergences(outcomes);
    text.push('\n');
    text += &parameters(unknowns, measurement, reported);
    if let Some(energies) = energies {
        let _ = write!(text, "{}", energy(energies));
    }
    text
}

/// Explains why there is no fit, or no fit with a physical law of friction; empty if there is one.
fn no_fit(reported: &Outcome) -> String {
    match reported.result() {
        Ok(fit) => match fit.driving_friction() {
            Some(impossible) => format!(
                "No fit with friction that brakes: {impossible}. The law of friction is not that of \
                 the real pendulum; help: --friction nonnegative\n"
            ),
            None => String::new(),
        },
        Err(unfound) => format!("No fit: {unfound}.\n"),
    }
}

/// Describes the measured record, and the part of it that is fitted.
fn measured(arguments: &Arguments, measurement: &Measurement) -> String {
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
        "Fitted before {:.4} s, predicted from there on.\n",
        measurement.until
    ));
    text
}

/// Lists the errors of the angles, one line per friction law.
fn errors_by_law(measurement: &Measurement, outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    line("Angles less data, rms in mrad        in windows            one motion".to_owned());
    line(format!(
        "{:<22} {:>8} {:>8} {:>8} {:>9} {:>8}",
        "friction", "length", "fitted", "later", "fitted", "later"
    ));
    for outcome in outcomes {
        let [first, then] = outcome
            .windows
            .each_ref()
            .map(|errors| format!("{:.3}", 1e3 * errors.rms()));
        let [fitted, later] = one_motion(measurement, outcome)
            .map(|rms| rms.map_or("lost".to_owned(), |rms| format!("{:.3}", 1e3 * rms)));
        line(format!(
            "{:<22} {:>6} s {first:>8} {then:>8} {fitted:>9} {later:>8}",
            outcome.law.name(),
            outcome.window(),
        ));
    }
    text
}

/// How each fit ended.
fn convergences(outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes {
        for (kind, found) in [
            ("windows", &outcome.found.in_windows),
            ("one motion", &outcome.found.one_motion),
        ] {
            let words = match found {
                Ok(fit) => fit.convergence.to_string(),
                Err(unfound) => unfound.to_string(),
            };
            let _ = writeln!(text, "{}, {kind}: {words}.", outcome.law.name());
        }
    }
    text
}

/// Lists the parameters found with the reported law, and the frequencies.
fn parameters(unknowns: &Unknowns, measurement: &Measurement, reported: &Outcome) -> String {
    let law = reported.law.name();
    let (heading, fit) = match reported.result() {
        Ok(fit) if reported.found.one_motion.is_ok() => {
            ("Parameters by one motion".to_owned(), fit)
        }
        Ok(fit) => {
            let window = reported.window();
            let words =
                format!("Parameters by windows of {window} s, since one motion is not followed");
            (words, fit)
        }
        Err(unfound) => {
            let words = "No fit. The best that was tried";
            (words.to_owned(), &unfound.best)
        }
    };
    let mut text = format!("{heading}, friction {law}, SI units:\n");
    text += &estimates::table(fit, measurement.truth.as_deref());
    if reported.result().is_ok() && fit.driving_friction().is_some() {
        text += "They have no deviations, since no real pendulum has these constants.\n";
        text += &estimates::standing(unknowns, fit);
    } else if reported.result().is_ok() {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "Deviations are the larger of those by {} blocks of the record and of naive ones, which \
             take what is left over for white noise.",
            fit.blocks
        );
        text += &estimates::standing(unknowns, fit);
    }
    if !fit.frequencies.is_empty() {
        text.push('\n');
        text += &estimates::frequencies(fit);
    }
    text
}

fn energy(energies: &Energies) -> String {
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
    format!(
        "Energy of the fitted motion and of the measured one differ, of that at the start,\n  \
         with velocities by the fitted equations by {},\n  \
         with velocities by smoothness alone by {}.\n",
        compared(&energies.by_equations),
        compared(&energies.by_smoothness)
    )
}

fn one_motion(measurement: &Measurement, outcome: &Outcome) -> [Option<f64>; 2] {
    [
        (f64::NEG_INFINITY, measurement.until),
        (measurement.until, f64::INFINITY),
    ]
    .map(|(from, until)| Some(outcome.errors.as_ref()?.rms_between(from, until)))
}

/// Writes the parameters of the tree if they were found, the residuals of all angles, and the
/// energies.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write(
    job: &Job,
    unknowns: &Unknowns,
    measurement: &Measurement,
    outcome: &Outcome,
    energies: Option<&Energies>,
) -> Result<(), Failure> {
    if let Ok(fit) = outcome.result() {
        let links = measurement.links.iter().zip(&measurement.offsets);
        // Those of the fit come to those by which the file was read.
        let offsets = links.map(|(link, offset)| (link.clone(), offset + fit.offset(link)));
        estimates::write_parameters(job, unknowns, fit, offsets.collect())?;
        estimates::write_frequencies(job, fit)?;
    }
    let mut columns = vec![Column::new("time", "s")];
    for kind in ["window", "one_motion"] {
        let links = measurement.links.iter();
        columns.extend(links.map(|link| Column::new(format!("{kind}_{link}"), "rad")));
    }
    for by in ["equations", "smoothness"] {
        columns.push(Column::new(format!("energy_by_{by}"), "J"));
        columns.push(Column::new(format!("energy_by_{by}_error"), "J"));
    }
    columns.push(Column::new("fitted_energy", "J"));
    let [fitted, later] = &outcome.windows;
    let windows = fitted.rows.iter().chain(&later.rows);
    let times = measurement.record.times();
    let none = vec![None; measurement.links.len()];
    job.csv("errors.csv", &columns, |file| {
        for (index, (window, &time)) in windows.zip(times).enumerate() {
            let one = outcome
                .errors
                .as_ref()
                .map_or(&none, |one| &one.rows[index]);
            let mut row = vec![time];
            let errors = window.iter().chain(one);
            row.extend(errors.map(|error| error.unwrap_or(f64::NAN)));
            match energies {
                Some(energies) => {
                    for energy in [&energies.by_equations, &energies.by_smoothness] {
                        row.extend([energy.values[index], energy.deviations[index]]);
                    }
                    row.push(energies.fitted[index]);
                }
                None => row.extend([f64::NAN; 5]),
            }
            file.row(row)?;
        }
        Ok(())
    })
}

/// Writes the results to the record of the run.
pub fn record(
    job: &Job,
    measurement: &Measurement,
    outcomes: &[Outcome],
    energies: Option<&Energies>,
) {
    for outcome in outcomes {
        job.report(
            outcome.law.name(),
            json!({
                "in_windows": searched(&outcome.found.in_windows),
                "by_one_motion": searched(&outcome.found.one_motion),
                "window": outcome.window(),
                "windows": outcome.windows.each_ref().map(|errors| errors.rms()),
                "one_motion": one_motion(measurement, outcome),
            }),
        );
    }
    let findings = measurement.findings.iter().map(ToString::to_string);
    job.report("findings", findings.collect::<Vec<_>>());
    job.report("release", measurement.release);
    let Some(energies) = energies else {
        return;
    };
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

/// Returns the outcome of a search for the record of the run.
pub fn searched(found: &SearchOutcome) -> Value {
    let fit = best(found);
    let parameters = fit.estimates.iter().chain(&fit.ratios).map(|estimate| {
        json!({
            "name": estimate.name,
            "value": estimate.value,
            "goes_with": match &estimate.standing {
                Standing::GoesWith(held) => json!(held),
                _ => json!([]),
            },
            "deviation": estimate.deviation(),
            "naive": estimate.naive,
        })
    });
    json!({
        "failure": found.as_ref().err().map(ToString::to_string),
        "noise": fit.convergence.noise,
        "residual": fit.convergence.rms,
        "frequencies": estimates::recorded_frequencies(fit),
        "starts": fit.convergence.starts,
        "agreed": fit.convergence.agreed,
        "determined": fit.identifiability.determined(),
        "parameters": parameters.collect::<Vec<_>>(),
    })
}
