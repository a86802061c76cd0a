//! Identification of parameters from frequencies of small motions only.

use std::fmt::Write;

use branched_pendulum_measure::identification::{AngleRecord, Fit, IdentificationError, best};

use super::arguments::{Arguments, Law};
use super::estimates;
use super::report::searched;
use super::study::{WINDOW, identification};
use super::unknowns::Unknowns;
use crate::Failure;
use crate::frame::Job;

/// Fits the frequencies, prints the report and writes the tables.
///
/// # Errors
/// [`Failure`]; also, after the report, if the fit has no valid result.
pub fn run(arguments: &Arguments, unknowns: &Unknowns, job: &Job) -> Result<(), Failure> {
    // Laws of friction cannot be distinguished.
    let task = identification(arguments, unknowns, Law::All);
    let observer = |_: &_| std::ops::ControlFlow::Continue(());
    let found = task.fit_by_windows(&AngleRecord::default(), WINDOW, None, &observer)?;
    let outcome = found.in_windows;
    let fit = best(&outcome);
    let mut text = estimates::frequencies(fit);
    match &outcome {
        Ok(fit) => text += &account(unknowns, fit),
        Err(unfound) => {
            let table = estimates::table(fit, None);
            // Writing to a string cannot fail.
            let _ = write!(
                text,
                "\nNo fit: {unfound}.\nThe best that was tried, SI units:\n{table}"
            );
        }
    }
    job.print(&text)?;
    job.report("by_frequencies", searched(&outcome));
    let fit = outcome.map_err(IdentificationError::NotFound)?;
    estimates::write_parameters(job, unknowns, &fit, Vec::new())?;
    estimates::write_frequencies(job, &fit)
}

/// Describes the result and the evidence for it.
fn account(unknowns: &Unknowns, fit: &Fit) -> String {
    let mut text = String::new();
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    let squares: f64 = fit
        .frequencies
        .iter()
        .map(|own| own.residual().powi(2))
        .sum();
    let more = fit
        .frequencies
        .len()
        .saturating_sub(fit.identifiability.determined());
    line(match more {
        0 => "As many frequencies as are needed: none is left to check them by.".to_owned(),
        _ => format!(
            "Sum of squares of what they are above: {squares:.2}, where {more} ± {:.1} is expected.",
            (2.0 * more as f64).sqrt()
        ),
    });
    line(format!("{}.\n", fit.convergence));
    line("Parameters by frequencies alone, SI units:".to_owned());
    text += &estimates::table(fit, None);
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    line("Deviations follow from the standard errors of the frequencies.".to_owned());
    for values in &fit.alternatives {
        let each = fit.estimates.iter().zip(values);
        let each = each.map(|(own, value)| format!("{} = {value:.6e}", own.name));
        line(format!(
            "The frequencies are met as well by {}: the start decides which is found, a value by \
             --set which is real.",
            each.collect::<Vec<_>>().join(", ")
        ));
    }
    text += &estimates::standing(unknowns, fit);
    text
}
