//! What was read, assumed and found, in words and as a table.

use std::fmt::Write;

use branched_pendulum_data::Column;

use super::arguments::Arguments;
use super::estimate::{Estimate, quantity};
use super::source::Source;
use crate::failure::Failure;
use crate::program::Job;

/// Writes the estimate: a row a time, each quantity with its standard deviation.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write(job: &Job, source: &Source, estimate: &Estimate) -> Result<(), Failure> {
    let mut columns = vec![Column::new("time", "s")];
    columns.extend(["theta_1", "theta_m", "theta_d"].map(|name| Column::new(name, "rad")));
    let quantities = [
        ("omega_1", "rad/s"),
        ("omega_m", "rad/s"),
        ("omega_d", "rad/s"),
        ("H_d", "J"),
        ("W", "W"),
        ("flowed", "J"),
        ("closure", "J"),
    ];
    for (name, unit) in quantities {
        columns.push(Column::new(name, unit));
        columns.push(Column::new(format!("{name}_error"), unit));
    }
    job.csv("estimate.csv", &columns, |file| {
        let bands = &estimate.bands;
        for (index, time) in source.times.iter().enumerate() {
            let mut row = vec![*time];
            row.extend(&estimate.motion[index][..3]);
            for (mean, deviation) in bands.means[index].iter().zip(&bands.deviations[index]) {
                row.extend([mean, deviation]);
            }
            file.row(row)?;
        }
        Ok(())
    })
}

/// How far an estimate is to be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trust {
    /// Largest H_d, J.
    pub energy: f64,
    /// Largest |∫ dH_d/dt dt − ΔH_d|, of that.
    pub closure: f64,
    /// Its standard deviation there, of that.
    pub closure_deviation: f64,
    /// Root mean square of the deviation of W, of that of W.
    pub transfer: f64,
}

impl Trust {
    /// Judges an estimate.
    pub fn of(estimate: &Estimate) -> Self {
        let bands = &estimate.bands;
        let means = || bands.means.iter();
        let energy = means().map(|row| row[quantity::ENERGY]).fold(0.0, f64::max);
        let rows = means().zip(&bands.deviations);
        let closure = rows
            .map(|(mean, deviation)| [mean[quantity::CLOSURE].abs(), deviation[quantity::CLOSURE]]);
        let [closure, deviation] = closure.fold([0.0; 2], |a, b| if b[0] > a[0] { b } else { a });
        let square = |rows: &[[f64; quantity::COUNT]]| {
            rows.iter()
                .map(|row| row[quantity::TRANSFER].powi(2))
                .sum::<f64>()
        };
        Self {
            energy,
            closure: closure / energy,
            closure_deviation: deviation / energy,
            transfer: (square(&bands.deviations) / square(&bands.means)).sqrt(),
        }
    }
}

/// The report in words.
pub fn report(arguments: &Arguments, source: &Source, estimate: &Estimate) -> String {
    let mut text = String::new();
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    match &arguments.file {
        Some(file) => line(format!("{}: {} times", file.display(), source.times.len())),
        None => line(format!(
            "Simulated camera: {} pictures of a release from {}°, θ_d(0) = {} rad",
            source.times.len(),
            arguments.angle,
            arguments.difference
        )),
    }
    for finding in &source.findings {
        line(format!("  {finding}"));
    }
    let trust = Trust::of(estimate);
    let percent = |part: f64| format!("{:.2} %", 100.0 * part);
    line(match arguments.model {
        true => {
            "Estimated with the equations of motion, and what they lack by likelihood.".to_owned()
        }
        false => "Estimated from smoothness alone.".to_owned(),
    });
    line(format!(
        "  angles are good to {:.2e} rad (found from the data)",
        estimate.noise
    ));
    line(format!("  largest H_d {:.4e} J", trust.energy));
    line(format!(
        "  W to {} (rms of its deviation, of that of W)",
        percent(trust.transfer)
    ));
    line(format!(
        "  ∫ dH_d/dt dt differs from the change of H_d by {} of the largest H_d, {} expected",
        percent(trust.closure),
        percent(trust.closure_deviation)
    ));
    // With the model the rule of quadrature is what is left of it.
    if !arguments.model && trust.closure > 3.0 * trust.closure_deviation {
        line(
            "  that is too much: the pendulum is not the paper's with this friction, or the \
             pictures are too few"
                .to_owned(),
        );
    }
    let white = estimate.whiteness;
    line(match white.abs() {
        ..3.0 => format!("  what is left over is white ({white:.1} deviations)"),
        _ => format!(
            "  what is left over is not white ({white:.1} deviations): the errors are larger \
             than told here"
        ),
    });
    if let Some(error) = transfer_error(source, estimate) {
        line(format!(
            "  true error of W {} (rms, of that of W)",
            percent(error)
        ));
    }
    text
}

/// The error of W against the truth of a simulated camera, rms over rms.
pub fn transfer_error(source: &Source, estimate: &Estimate) -> Option<f64> {
    let truth = source
        .truth
        .iter()
        .map(|sample| sample.flow.transfer[2].total());
    let pairs = truth.zip(&estimate.bands.means);
    let (error, size) = pairs.fold((0.0, 0.0), |(error, size), (truth, row)| {
        let off = row[quantity::TRANSFER] - truth;
        (error + off * off, size + truth * truth)
    });
    (size > 0.0).then(|| (error / size).sqrt())
}
