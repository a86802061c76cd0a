//! Words and tables.

use branched_pendulum::analysis::statistics::{Average, Estimate, StatisticsError};
use branched_pendulum_data::Column;

use super::arguments::Arguments;
use super::budgets::QUANTITIES;
use super::equilibrium::{EQUILIBRIUM_METHODS, Equilibrium};
use super::findings::{Findings, LEVEL, ScaleState};
use super::motion::Followed;
use super::tree::DrivenTree;
use crate::Failure;
use crate::frame::Job;
use crate::subject::Subject;

/// Returns the printed report, as Markdown.
pub fn report(
    arguments: &Arguments,
    driven: &DrivenTree,
    starts: &[Followed],
    findings: &Findings,
) -> String {
    let mut text = format!(
        "{}: {} links in {} generations, {} starts of {:.1} s each; {}; {} steps a period.\n\n",
        driven.subject.name,
        driven.links(),
        driven.generations(),
        starts.len(),
        arguments.windows() as f64 / arguments.frequency,
        drive(arguments, &driven.subject),
        arguments.steps,
    );
    text.push_str(&steadiness(arguments, findings));
    text.push_str(&energies(arguments, driven, findings));
    text.push_str(&balance(arguments, findings));
    text.push_str(&findings.structure.table(LEVEL));
    text
}

/// Says what drives the tree.
pub fn drive(arguments: &Arguments, subject: &Subject) -> String {
    let frequency = arguments.frequency;
    if subject.tree.drive(0.0).is_some() {
        return format!("driven as described, periods of {frequency} Hz");
    }
    if let Some(noise) = arguments.noise {
        let kicks = frequency * f64::from(arguments.samples);
        return format!("white noise of {noise} N² m² s on the root, {kicks} kicks a second");
    }
    let width = match arguments.bandwidth {
        0.0 => String::new(),
        width => format!(" ± {width} Hz"),
    };
    let torque = arguments.torque(subject);
    format!("torque {torque} N m at {frequency} Hz{width} on the root")
}

/// Says if averages mean anything.
fn steadiness(arguments: &Arguments, findings: &Findings) -> String {
    let second = 1.0 / arguments.frequency;
    let mut text = match findings.transient {
        Ok(windows) => format!("The transient ends after {:.1} s", windows as f64 * second),
        Err(error) => {
            format!("The transient does not end ({error}); the second half is shown")
        }
    };
    match &findings.drift {
        Ok(drift) => {
            let verdict = if findings.is_steady() {
                "steady"
            } else {
                "NOT steady"
            };
            text += &format!(
                "; from its first to its second half the energy changes by {:.2e} ± {:.1e} J: {verdict}.\n\n",
                drift.change, drift.error
            );
        }
        Err(error) => text += &format!("; NOT steady: {error}.\n\n"),
    }
    text
}

/// Energies by scale.
fn energies(arguments: &Arguments, driven: &DrivenTree, findings: &Findings) -> String {
    let mut text =
        "| scale | degrees of freedom | energy (J) | bar | per degree of freedom (J) | τ (s) |\n\
         |---|---:|---:|---:|---:|---:|\n"
            .to_owned();
    let mut missing = Missing::default();
    for (scale, state) in findings.scales.iter().enumerate() {
        let freedoms = driven.degrees_of_freedom(scale);
        text += &format!("| {} | {freedoms} |", name(scale));
        match state {
            ScaleState::Awake(energy) => {
                text += &format!(
                    " {:.4e} | {:.1} % | {:.4e} | {:.2} |\n",
                    energy.mean,
                    100.0 * energy.error / energy.mean,
                    energy.mean / freedoms as f64,
                    energy.correlation_time / arguments.frequency
                )
            }
            ScaleState::Asleep(energy) => {
                text += &format!(" asleep ({energy:.0e}) | | | |\n");
            }
            ScaleState::Unsettled(error) => {
                text += " – | | | | |\n";
                missing.add(format!("scale {scale}"), error);
            }
        }
    }
    text += &missing.list_reasons(arguments);
    match findings.law {
        Some(law) => {
            text += &format!(
                "\nEnergy per degree of freedom of the differences against the length of the oldest \
                 links that differ: exponent {:.3} ± {:.3}, χ² per point left over {:.1}: {}.\n\n",
                law.exponent.value,
                law.exponent.error,
                law.misfit,
                if law.misfit < 4.0 {
                    "a power law within the bars"
                } else {
                    "no power law"
                }
            )
        }
        None => text.push_str("\nToo few scales are awake for a power law.\n\n"),
    }
    text
}

/// Compares the energies of the scales with those in thermal equilibrium, in a table.
pub fn equilibrium(driven: &DrivenTree, findings: &Findings, own: &Equilibrium) -> String {
    let discord = own.discord();
    let mut text = format!(
        "\nIn thermal equilibrium at the same energy, {:.4e} J, kT is {:.4e} J. The three ways differ by at \
         most {discord:.1} of their bars: {}.\n\n\
         {}| scale | {} (J) | {} (J) | {} (J) | ½ kT a degree of freedom (J) | driven over it |\n\
         |---|---:|---:|---:|---:|---:|\n",
        own.energy,
        own.temperature,
        match discord < 4.0 {
            true => "they agree",
            false => "they do NOT agree",
        },
        match own.left_out {
            0 => String::new(),
            some => format!(
                "{some} starts are left out of the third way: their potential energy alone is more.\n\n"
            ),
        },
        EQUILIBRIUM_METHODS[0],
        EQUILIBRIUM_METHODS[1],
        EQUILIBRIUM_METHODS[2],
    );
    for (scale, state) in findings.scales.iter().enumerate() {
        let ways = own.scales.each_ref().map(|way| match way.get(scale) {
            Some(own) => format!("{:.4e} ± {:.1} %", own.value, 100.0 * own.error / own.value),
            None => String::new(),
        });
        let over = match (state, own.scales[0].get(scale)) {
            (ScaleState::Awake(energy), Some(own)) => format!("{:.3}", energy.mean / own.value),
            _ => String::new(),
        };
        let freedoms = driven.degrees_of_freedom(scale) as f64;
        text += &format!(
            "| {} | {} | {:.4e} | {over} |\n",
            name(scale),
            ways.join(" | "),
            0.5 * freedoms * own.temperature,
        );
    }
    text
}

/// Name of a scale.
pub fn name(scale: usize) -> String {
    match scale {
        0 => "0 (means)".to_owned(),
        scale => scale.to_string(),
    }
}

/// Input, fluxes, dissipation.
fn balance(arguments: &Arguments, findings: &Findings) -> String {
    let source = arguments.source();
    let mut missing = Missing::default();
    let mut watts = |name: &str, average: &Result<Average, StatisticsError>| match average {
        Ok(average) => milli(average),
        Err(error) => {
            missing.add(name.to_owned(), error);
            "–".to_owned()
        }
    };
    let mut text = format!(
        "Input by the {source}: {} mW; friction: {} mW; difference: {} mW: {}.\n\n\
         | into scale | from W (mW) | dissipated there and below (mW) | difference (mW) | skewness of W | \
         flatness of W |\n\
         |---|---:|---:|---:|---:|---:|\n",
        watts("the input", &findings.input),
        watts("friction", &findings.dissipation),
        watts("the balance", &findings.loss),
        findings.balance().verdict(&longer(arguments)),
    );
    for (index, flux) in findings.fluxes.iter().enumerate() {
        text += &format!("| {} |", index + 1);
        match flux {
            Ok(flux) => {
                text += &format!(
                    " {} | {} | {} | {} | {} |\n",
                    milli(&flux.transferred),
                    milli(&flux.dissipated),
                    milli(&flux.gap),
                    moment(flux.skewness),
                    moment(flux.flatness),
                )
            }
            Err(error) => {
                text += " – | | | | |\n";
                missing.add(format!("the flux into scale {}", index + 1), error);
            }
        }
    }
    text + missing.list_reasons(arguments).as_str()
}

/// Suggests a longer run, if this one is too short.
fn longer(arguments: &Arguments) -> String {
    format!("at least `--duration {}`", 2.0 * arguments.duration)
}

/// Averages that could not be computed because the run is too short, with the reasons.
#[derive(Debug, Default)]
struct Missing(Vec<(String, StatisticsError)>);

impl Missing {
    fn add(&mut self, name: String, error: &StatisticsError) {
        self.0.push((name, *error));
    }

    /// Lists the reasons, one per line, and what to do.
    fn list_reasons(&self, arguments: &Arguments) -> String {
        let mut text = String::new();
        for (name, error) in &self.0 {
            text += &format!("\nNo average of {name}: {error}.");
        }
        if !text.is_empty() {
            text += &format!("\nTake {}.\n\n", longer(arguments));
        }
        text
    }
}

/// Formats a moment of a distribution with its error.
fn moment(own: Option<Estimate>) -> String {
    let text = own.map(|own| format!("{:.2} ± {:.2}", own.value, own.error));
    text.unwrap_or_default().replace('-', "−")
}

/// Formats a power in mW with its error.
fn milli(average: &Average) -> String {
    let text = format!("{:.4} ± {:.4}", 1e3 * average.mean, 1e3 * average.error);
    text.replace('-', "−")
}

/// Writes a table of the means over each window, for all starts.
///
/// # Errors
/// [`Failure`].
pub fn write_windows(
    job: &Job,
    arguments: &Arguments,
    scales: usize,
    starts: &[Followed],
) -> Result<(), Failure> {
    let mut columns = vec![Column::new("start", ""), Column::new("time", "s")];
    for scale in 0..scales {
        for (quantity, unit) in [
            ("energy", "J"),
            ("received", "W"),
            ("friction", "W"),
            ("motor", "W"),
        ] {
            columns.push(Column::new(format!("{quantity} {scale}"), unit));
        }
    }
    job.csv("windows.csv", &columns, |file| {
        for (number, start) in starts.iter().enumerate() {
            let rows = start.windows.chunks_exact(QUANTITIES * scales);
            for (window, row) in rows.enumerate() {
                // In the middle of the window.
                let time = (window as f64 + 0.5) / arguments.frequency;
                let mut numbers = vec![number as f64, time];
                numbers.extend(row);
                file.row(&numbers)?;
            }
        }
        Ok(())
    })
}

/// Writes a table of the results for each scale.
///
/// # Errors
/// [`Failure`].
pub fn write_scales(
    job: &Job,
    driven: &DrivenTree,
    findings: &Findings,
    equilibrium: Option<&Equilibrium>,
) -> Result<(), Failure> {
    let columns = [
        ("scale", ""),
        ("length", "m"),
        ("degrees of freedom", ""),
        ("energy", "J"),
        ("error of energy", "J"),
        ("flux by W", "W"),
        ("error of flux by W", "W"),
        ("flux by dissipation", "W"),
        ("error of flux by dissipation", "W"),
        ("mass", "kg"),
        ("mass of subtrees", "kg"),
        ("flatness of W", ""),
        ("error of flatness of W", ""),
    ];
    let mut columns = columns.map(|(name, unit)| Column::new(name, unit)).to_vec();
    if equilibrium.is_some() {
        columns.push(Column::new("energy in equilibrium", "J"));
        columns.push(Column::new("error of energy in equilibrium", "J"));
    }
    job.csv("scales.csv", &columns, |file| {
        for (scale, state) in findings.scales.iter().enumerate() {
            let bar = |average: &Average| [average.mean, average.error];
            let none = [f64::NAN; 2];
            let energy = match state {
                ScaleState::Awake(average) => bar(average),
                ScaleState::Asleep(_) | ScaleState::Unsettled(_) => none,
            };
            let flux = scale
                .checked_sub(1)
                .and_then(|flux| findings.fluxes.get(flux));
            let [given, lost] = match (flux, &findings.input, &findings.dissipation) {
                (Some(Ok(flux)), ..) => [bar(&flux.transferred), bar(&flux.dissipated)],
                // What enters the whole tree.
                (None, Ok(input), Ok(lost)) => [bar(input), bar(lost)],
                _ => [none; 2],
            };
            let length = driven.lengths.get(scale).copied();
            let mut row = vec![scale as f64, length.unwrap_or(f64::NAN)];
            row.push(driven.degrees_of_freedom(scale) as f64);
            row.extend([energy, given, lost].concat());
            for masses in [&driven.masses, &driven.subtrees] {
                row.push(masses.get(scale).copied().unwrap_or(f64::NAN));
            }
            let flatness = flux.and_then(|flux| flux.as_ref().ok()?.flatness);
            row.extend(flatness.map_or(none, |own| [own.value, own.error]));
            if let Some(equilibrium) = equilibrium {
                let [thermal, ..] = &equilibrium.scales;
                let own = thermal.get(scale);
                row.extend(own.map_or([f64::NAN; 2], |own| [own.value, own.error]));
            }
            file.row(&row)?;
        }
        Ok(())
    })
}
