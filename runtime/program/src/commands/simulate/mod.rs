//! The motion of a tree.

mod determined;

use std::fmt::Write;

use branched_pendulum::Energy;
use branched_pendulum::prelude::*;
use branched_pendulum_charts::{Axis, Chart, Film, Panel, Series, verbatim};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::TreeError;
use clap::Parser;

use self::determined::Determined;
use crate::Failure;
use crate::budget::{self, SectorSeries};
use crate::frame::command_line::number;
use crate::frame::film;
use crate::frame::{Charts, Job};
use crate::motion::{MethodArguments, SampledMotion, sample};
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// How does a tree move? Integrates its motion from a start; writes angles, velocities, energies
/// and powers as a table, for copies also their differences with their energy H_d and the energy
/// transfer W; draws charts and, on request, a film.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum simulate", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    method: MethodArguments,
    /// duration of the motion, s from 0.01 to 1e5
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.01..=1e5, "s"))]
    duration: f64,
    /// samples per second, 1 to 1e5
    #[arg(long, value_name = "HZ", default_value = "100", value_parser = number(1.0..=1e5, "Hz"))]
    rate: f64,
    /// requested precision of angles, in degrees from 1e-9 to 10: the motion is reported as not
    /// determined from the time on at which a second run with a tighter tolerance differs by more
    #[arg(verbatim_doc_comment, long, value_name = "DEG", default_value = "1e-6", value_parser = number(1e-9..=10.0, "degrees"))]
    precision: f64,
    /// leaves out the second run, and with it the statement how long the motion is determined
    #[arg(long)]
    once: bool,
    /// also makes a film, as SVG and animated PNG
    #[arg(long)]
    film: bool,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("simulate-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        Some(self.duration)
    }

    fn check(&self) -> Result<(), String> {
        match self.duration * self.rate <= MOST_SAMPLES {
            true => Ok(()),
            false => Err(format!(
                "`--duration` times `--rate` is more than {MOST_SAMPLES} samples"
            )),
        }
    }
}

const MOST_SAMPLES: f64 = 1e7;

/// Largest number of pictures per second of a film.
const PICTURES: f64 = 20.0;

/// Integrates the motion and writes it.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let start = arguments.release.state(&subject)?;
    let count = (arguments.duration * arguments.rate).round().max(1.0);
    let times = (0..=count as usize).map(|k| k as f64 * arguments.duration / count);
    let samples = sample(&subject, &arguments.method, &start, times.collect())?;
    let energies = SampledEnergies::of(&subject, &samples);
    let sectors = budget::along(&subject, &samples);
    let determined = match arguments.once {
        true => None,
        false => Some(Determined::of(arguments, &subject, &start, &samples)?),
    };
    job.print(&report(arguments, &subject, &samples, &energies))?;
    job.print(&ends(&subject, &samples, determined.as_ref()))?;
    job.print(&subject.unstable_release(&start).unwrap_or_default())?;
    if let Some(determined) = &determined {
        job.print(&determined.in_words(arguments, &subject))?;
        job.report("precision (deg)", arguments.precision);
        job.report("determined until (s)", determined.until);
    }
    write(job, &subject, &samples, &energies)?;
    charts(job, &subject, &samples, &energies)?;
    if let Err(error @ (TreeError::CoupledSectors | TreeError::StraightSpring { .. })) =
        subject.tree.symmetric()
    {
        job.print(&format!("no H_d and no W: {error}\n"))?;
    }
    if let Some(sectors) = &sectors {
        job.print(&differences(&samples, sectors))?;
        budget::write(job, &subject, &samples.times, sectors)?;
    }
    if arguments.film {
        let stride = (arguments.rate / PICTURES).round().max(1.0) as usize;
        let tree = &subject.tree;
        let pictures = samples.states.iter().step_by(stride);
        let pictures: Vec<Vec<f64>> = pictures
            .map(|state| film::angles(tree, &state[..tree.links()]))
            .collect();
        let film = Film::new(verbatim(&subject.name), stride as f64 / arguments.rate);
        job.film("film", &film.tree("", &film::links(tree), &pictures)?)?;
    }
    Ok(())
}

/// Describes the energies of the differences between copies.
fn differences(samples: &SampledMotion, sectors: &[SectorSeries]) -> String {
    let mut text = String::new();
    for sector in sectors.iter().filter(|sector| sector.name != "in_phase") {
        let most = sector.energies.iter().copied().fold(0.0, f64::max);
        let [added, gained] = sector.gains(&samples.times);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  difference {}: H_d {most:.3e} J at most, gained {gained:.4e} J; W and powers between \
             the samples add {added:.4e} J",
            sector.name
        );
        let largest = |cause: usize| {
            let own = sector.causes.iter().map(|own| own[cause].abs());
            own.reduce(f64::max)
        };
        if let (Some(growth), Some(forcing)) = (largest(0), largest(1)) {
            let _ = writeln!(
                text,
                "    its copies differ: W is growth, at most {growth:.3e} W, and forcing, at most \
                 {forcing:.3e} W"
            );
        }
    }
    text
}

/// A function of time, angles and angular velocities.
type AtState<'a> = dyn Fn(f64, &[f64], &[f64]) -> f64 + 'a;

/// Energies and powers at all samples.
struct SampledEnergies {
    kinetic: Vec<f64>,
    potential: Vec<f64>,
    friction_power: Vec<f64>,
    drive_power: Vec<f64>,
}

impl SampledEnergies {
    fn of(subject: &Subject, samples: &SampledMotion) -> Self {
        let tree = &subject.tree;
        let each = |of: &AtState<'_>| -> Vec<f64> {
            let both = samples.times.iter().zip(&samples.states);
            both.map(|(time, state)| {
                let (theta, omega) = state.split_at(tree.links());
                of(*time, theta, omega)
            })
            .collect()
        };
        Self {
            kinetic: each(&|_, theta, omega| tree.kinetic_energy_of(theta, omega)),
            potential: each(&|_, theta, _| tree.potential_energy_of(theta)),
            friction_power: each(&|_, theta, omega| tree.friction_power(theta, omega)),
            drive_power: each(&|time, theta, omega| tree.drive_power(time, theta, omega)),
        }
    }

    fn total(&self) -> Vec<f64> {
        let both = self.kinetic.iter().zip(&self.potential);
        both.map(|(kinetic, potential)| kinetic + potential)
            .collect()
    }
}

fn report(
    arguments: &Arguments,
    subject: &Subject,
    samples: &SampledMotion,
    energies: &SampledEnergies,
) -> String {
    let total = energies.total();
    let (first, last) = (total[0], total[total.len() - 1]);
    let mut text = format!(
        "{}: {} s with {}, {}\n",
        subject.name,
        arguments.duration,
        arguments.method.method(&subject.tree).title(),
        samples.report
    );
    let powers = energies.friction_power.iter().chain(&energies.drive_power);
    // Writing to a string cannot fail.
    let _ = match powers.copied().all(|power| power == 0.0) {
        true => {
            let change = |energy: &f64| (energy - first).abs();
            let largest = total.iter().map(change).fold(0.0, f64::max);
            writeln!(
                text,
                "energy {first:.6e} J, which is kept to {largest:.1e} J"
            )
        }
        false => writeln!(
            text,
            "energy {first:.6e} J at the start, {last:.6e} J at the end"
        ),
    };
    text
}

/// Lists the angles at the end, with the digits that are determined.
fn ends(subject: &Subject, samples: &SampledMotion, determined: Option<&Determined>) -> String {
    let mut text = String::new();
    let end = samples.states.last().map_or(&[][..], Vec::as_slice);
    for (link, (name, angle)) in subject.tree.names().iter().zip(end).enumerate() {
        let angle = angle.to_degrees();
        // Writing to a string cannot fail.
        let _ = match determined.map(|own| own.error_at_end(link)) {
            None => writeln!(text, "  {name} ends at {angle:.6}°"),
            Some(Some(error)) => {
                // The error is in the last digit, or in the one before it.
                let digits = (-error.log10()).floor().clamp(0.0, 6.0) as usize;
                writeln!(text, "  {name} ends at {angle:.digits$}°")
            }
            Some(None) => writeln!(text, "  {name} ends at an angle that is not determined"),
        };
    }
    text
}

fn write(
    job: &Job,
    subject: &Subject,
    samples: &SampledMotion,
    energies: &SampledEnergies,
) -> Result<(), Failure> {
    let names = subject.tree.names();
    let mut columns = vec![Column::new("time", "s")];
    columns.extend(names.iter().map(|name| Column::new(name.as_str(), "rad")));
    let rates = names.iter().map(|name| format!("{name} rate"));
    columns.extend(rates.map(|name| Column::new(name, "rad/s")));
    for name in ["kinetic energy", "potential energy"] {
        columns.push(Column::new(name, "J"));
    }
    for name in ["friction power", "drive power"] {
        columns.push(Column::new(name, "W"));
    }
    job.csv("motion.csv", &columns, |csv| {
        let SampledEnergies {
            kinetic,
            potential,
            friction_power,
            drive_power,
        } = energies;
        for (row, (time, state)) in samples.times.iter().zip(&samples.states).enumerate() {
            let own = [kinetic, potential, friction_power, drive_power].map(|all| all[row]);
            let all = std::iter::once(time).chain(state).chain(&own);
            csv.row(all.map(|value| Cell::from(*value)))?;
        }
        Ok(())
    })
}

/// Largest number of links whose angles are drawn with one line each.
const MOST_LINES: usize = 8;

fn charts(
    job: &Job,
    subject: &Subject,
    samples: &SampledMotion,
    energies: &SampledEnergies,
) -> Result<(), Failure> {
    let times = &samples.times;
    let end = times.last().copied().unwrap_or(0.0);
    let angles = Panel::new(Axis::linear("angle (°)")).zero_line();
    let names = subject.tree.names().iter().enumerate().take(MOST_LINES);
    let angles = names.fold(angles, |panel, (link, name)| {
        let own = samples.states.iter().map(|state| state[link].to_degrees());
        panel.series(Series::line(
            verbatim(name),
            times,
            &own.collect::<Vec<_>>(),
        ))
    });
    let panel = Panel::new(Axis::linear("energy (J)"))
        .line("kinetic", times, &energies.kinetic)
        .line("potential", times, &energies.potential)
        .line("sum", times, &energies.total());
    let chart = Chart::new(
        verbatim(&subject.name),
        Axis::linear("time (s)").range(0.0, end),
    );
    job.chart_over_time(
        "motion",
        &chart.panel(angles).panel(panel).size(900.0, 620.0),
    )
}
