//! Findings, assumptions and results, as text and as a table.

use std::fmt::Write;

use branched_pendulum_data::Column;

use super::arguments::Arguments;
use super::estimate::{Estimate, quantity};
use super::source::Source;
use super::subject::Names;
use crate::Failure;
use crate::frame::Job;

/// Correlation (in standard deviations) above which innovations are not considered white; about
/// one record in a hundred exceeds it by chance.
const WHITE: f64 = 3.0;

/// Writes the estimate as a table with one row per time; each quantity has its standard deviation.
///
/// # Errors
/// [`Failure::Csv`] or [`Failure::File`].
pub fn write(
    job: &Job,
    names: &Names,
    source: &Source,
    estimate: &Estimate,
) -> Result<(), Failure> {
    let mut columns = vec![Column::new("time", "s")];
    let coordinates = names.coordinates.iter();
    columns.extend(coordinates.map(|name| Column::new(name.as_str(), "rad")));
    let rates = names.coordinates.iter();
    let rates: Vec<String> = rates
        .map(|name| name.replacen("theta", "omega", 1))
        .collect();
    let rates = rates.iter().map(|name| (name.as_str(), "rad/s"));
    let energies = [
        (names.energy.as_str(), "J"),
        (names.power, "W"),
        ("flowed", "J"),
        ("closure", "J"),
    ];
    for (name, unit) in rates.chain(energies) {
        columns.push(Column::new(name, unit));
        columns.push(Column::new(format!("{name}_error"), unit));
    }
    job.csv("estimate.csv", &columns, |file| {
        let (rates, energies) = (&estimate.rates, &estimate.energies);
        for (index, time) in source.times.iter().enumerate() {
            let mut row = vec![*time];
            row.extend(&estimate.motion[index][0]);
            let of_rates = rates.means[index].iter().zip(&rates.deviations[index]);
            let of_energies = energies.means[index]
                .iter()
                .zip(&energies.deviations[index]);
            for (mean, deviation) in of_rates.chain(of_energies) {
                row.extend([mean, deviation]);
            }
            file.row(row)?;
        }
        Ok(())
    })
}

/// How far an estimate can be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trust {
    /// Largest energy, J.
    pub energy: f64,
    /// Largest |∫ power dt − change of the energy|, relative to the largest energy.
    pub closure: f64,
    /// Standard deviation of this closure error at the same time, relative to the largest energy.
    pub closure_deviation: f64,
    /// Root mean square of the power's standard deviation, relative to the root mean square of the
    /// power.
    pub power: f64,
}

impl Trust {
    /// Judges an estimate.
    pub fn of(estimate: &Estimate) -> Self {
        let bands = &estimate.energies;
        let means = || bands.means.iter();
        let energy = means().map(|row| row[quantity::ENERGY]).fold(0.0, f64::max);
        let rows = means().zip(&bands.deviations);
        let closure = rows
            .map(|(mean, deviation)| [mean[quantity::CLOSURE].abs(), deviation[quantity::CLOSURE]]);
        let [closure, deviation] = closure.fold([0.0; 2], |a, b| if b[0] > a[0] { b } else { a });
        let square = |rows: &[[f64; quantity::COUNT]]| {
            rows.iter()
                .map(|row| row[quantity::POWER].powi(2))
                .sum::<f64>()
        };
        Self {
            energy,
            closure: closure / energy,
            closure_deviation: deviation / energy,
            power: (square(&bands.deviations) / square(&bands.means)).sqrt(),
        }
    }
}

/// Formats a fraction in per cent.
pub fn percent(part: f64) -> String {
    match 100.0 * part {
        small @ ..0.01 => format!("{small:.1e} %"),
        usual => format!("{usual:.2} %"),
    }
}

/// The report in words.
pub fn report(
    arguments: &Arguments,
    names: &Names,
    source: &Source,
    estimate: &Estimate,
) -> String {
    let mut text = measured(arguments, source);
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    line(
        match (arguments.model, arguments.polynomials) {
            (true, _) => {
                "Estimated with the equations of motion, and what they lack by likelihood."
            }
            (_, true) => "Estimated by polynomials near each time.",
            _ => "Estimated from smoothness alone.",
        }
        .to_owned(),
    );
    for words in [
        accuracy(arguments, names, estimate),
        left_over(arguments, estimate),
    ] {
        line(words);
    }
    let frictions = names.pivots.iter().zip(&estimate.frictions);
    let frictions = frictions.filter(|(_, friction)| **friction != 0.0);
    let frictions: Vec<String> = frictions
        .map(|(pivot, friction)| format!("{friction:.3e} N m s in {pivot}"))
        .collect();
    if !frictions.is_empty() {
        line(format!(
            "  the equations lack friction of {}",
            frictions.join(", ")
        ));
    }
    if let Some(error) = power_error(source, estimate) {
        let power = names.power;
        line(format!(
            "  true error of {power} {} (rms, of that of {power})",
            percent(error)
        ));
    }
    text
}

/// Describes the measured record.
fn measured(arguments: &Arguments, source: &Source) -> String {
    let mut text = String::new();
    let mut line = |words: String| {
        let _ = writeln!(text, "{words}");
    };
    match &arguments.measured.file {
        Some(file) => line(format!("{}: {} times", file.display(), source.times.len())),
        None => line(format!(
            "Simulated camera: {} pictures of a release from {} (degrees), differences {} rad more",
            source.times.len(),
            arguments.release.start,
            arguments.difference
        )),
    }
    for finding in &source.findings {
        line(format!("  {finding}"));
    }
    text
}

/// Describes the accuracy of the angles, of the power and of its integral.
fn accuracy(arguments: &Arguments, names: &Names, estimate: &Estimate) -> String {
    let trust = Trust::of(estimate);
    let (energy, power) = (&names.energy, names.power);
    // By the equations the integral is not taken from picture to picture.
    let cause = match arguments.model {
        true => " of noise alone",
        false => "",
    };
    [
        format!(
            "  angles are good to {:.2e} rad (found from the data)",
            estimate.noise
        ),
        format!("  largest {energy} {:.4e} J", trust.energy),
        format!(
            "  {power} to {} (rms of its deviation, of that of {power})",
            percent(trust.power)
        ),
        format!(
            "  ∫ d{energy}/dt dt differs from the change of {energy} by {} of the largest {energy}, \
             {} expected{cause}",
            percent(trust.closure),
            percent(trust.closure_deviation)
        ),
    ]
    .join("\n")
}

/// Describes the test of the residuals: those of the equations of motion are white if the equations
/// are correct. Those of smoothness are not, because no pendulum moves with white jerk.
fn left_over(arguments: &Arguments, estimate: &Estimate) -> String {
    let white = estimate.whiteness;
    let words = match (arguments.model, arguments.polynomials) {
        (true, _) if white.abs() < WHITE => {
            return format!("  what is left over is white ({white:.1} deviations)");
        }
        (true, _) => {
            return format!(
                "  what is left over is not white ({white:.1} deviations): the errors are larger than \
                 these, since the equations of motion or the noise are others"
            );
        }
        (false, true) => {
            "errors are those of the noise: what polynomials do not follow is not in them"
        }
        (false, false) => "errors hold for white noise: --model tests whether it is white",
    };
    format!("  {words}")
}

/// Returns the relative error of the power: the root mean square of its difference from the true
/// values, which are known for a simulated camera, divided by the root mean square of the true
/// values.
pub fn power_error(source: &Source, estimate: &Estimate) -> Option<f64> {
    let pairs = source.truth.iter().zip(&estimate.energies.means);
    let (error, size) = pairs.fold((0.0, 0.0), |(error, size), (truth, row)| {
        let off = row[quantity::POWER] - truth.power;
        (error + off * off, size + truth.power * truth.power)
    });
    (size > 0.0).then(|| (error / size).sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::tests::{paper, tree};
    use super::super::{Draws, Measured, Source};
    use super::Trust;

    /// Returns the closure error by the equations of motion, in its standard deviations.
    fn closure(options: &str) -> f64 {
        let arguments = paper(options);
        let (described, subject) = tree(&arguments);
        let source = Source::simulate(&arguments, &described).unwrap();
        let measured = Measured {
            subject: &subject,
            record: source.record(),
        };
        let draws = Draws { count: 30, seed: 1 };
        let guess = measured.by_smoothness(draws).unwrap();
        let trust = Trust::of(&measured.by_model(&guess, draws).unwrap());
        trust.closure / trust.closure_deviation
    }

    /// Checks that dots rotated by half a degree are revealed by the closure, although the
    /// residuals of the angles are white.
    #[test]
    fn turned_dots_are_told_by_the_closure() {
        let right = closure("--rate 60");
        let turned = closure("--rate 60 --turned 0.5");
        assert!(right < 3.0 && turned > 5.0, "{right} {turned}");
    }
}
