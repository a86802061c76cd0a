//! Energy transfer W into the differences between copies: truncated forms compared with the exact
//! form.

mod amplitude;
mod cost;

use std::fmt::Write;

use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::StateInput;
use branched_pendulum::{Transfer, TransferForm};
use branched_pendulum_charts::{Axis, Chart, Panel, verbatim};
use branched_pendulum_data::{Cell, Column};
use branched_pendulum_trees::TreeError;
use clap::{Parser, ValueEnum};

use crate::Failure;
use crate::frame::command_line::number;
use crate::frame::{Charts, Job};
use crate::motion::{MethodArguments, sample};
use crate::release::ReleaseArguments;
use crate::subject::TreeArguments;

/// How accurate are approximations of W? Computes the energy transfer W into the differences
/// between copies along a motion, and compares its forms: exact, as published (angle order 1), and
/// truncated at orders of the amplitude. If copies are not identical, splits W into growth and
/// forcing. With `--against amplitude`, finds the amplitude of the differences at which each form
/// fails, and its cost.
///
/// The amplitude of a state is that of the linear oscillation through it, for the largest of the
/// differences. The error at an amplitude is the rms of W − W_exact divided by the rms of W_exact:
/// over random states within the range of the in-phase motion in the first 10 s, and along motions
/// that are released with 49 disturbances from 0.0001 to 1 rad.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum transfer", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    method: MethodArguments,
    /// quantity against which the forms are compared
    #[arg(long, value_enum, value_name = "QUANTITY", default_value_t = Against::Time)]
    against: Against,
    /// duration of the motion, s from 0.01 to 1e5
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.01..=1e5, "s"))]
    duration: f64,
    /// samples per second, 1 to 1e4
    #[arg(long, value_name = "HZ", default_value = "100", value_parser = number(1.0..=1e4, "Hz"))]
    rate: f64,
    /// sector that receives the energy; by default the first difference, with `--against amplitude`
    /// all differences
    #[arg(verbatim_doc_comment, long, value_name = "SECTOR")]
    into: Option<String>,
    /// amplitude: number of random states at each amplitude, 10 to 1000000
    #[arg(long, value_name = "N", default_value = "2000", value_parser = clap::value_parser!(u32).range(10..=1_000_000))]
    states: u32,
    /// amplitude: seed of the random states
    #[arg(long, value_name = "SEED", default_value = "0")]
    seed: u64,
}

/// Reference of the forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Against {
    /// Time along one motion.
    Time,
    /// Amplitude of the differences.
    Amplitude,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("transfer-output");
    const CHARTS: Charts = Charts::OverTime;

    fn followed(&self) -> Option<f64> {
        Some(self.duration)
    }
}

/// Forms of W that are compared; `Angle(1)` is the published one.
const FORMS: [TransferForm; 6] = [
    TransferForm::Exact,
    TransferForm::Angle(1),
    TransferForm::Amplitude(2),
    TransferForm::Amplitude(4),
    TransferForm::Amplitude(6),
    TransferForm::Amplitude(8),
];

/// Computes W by all forms and writes the results.
///
/// # Errors
/// [`Failure`]; [`Failure::Tree`] if the tree has no copies, [`Failure::Lacking`] if W is zero
/// along the whole motion.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let refused = |source: TreeError| Failure::tree(&subject.name, source);
    let symmetric = subject.tree.symmetric().map_err(refused)?;
    let names: Vec<&str> = symmetric
        .sectors()
        .iter()
        .map(|sector| sector.name())
        .collect();
    let named = |name: &String| {
        symmetric.sector(name).ok_or_else(|| Failure::Lacking {
            what: format!(
                "there is no sector `{name}`: the tree has {}",
                names.join(", ")
            ),
        })
    };
    let into = arguments.into.as_ref().map(named).transpose()?;
    let start = arguments.release.state(&subject)?;
    if arguments.against == Against::Amplitude {
        return amplitude::run(arguments, job, &subject, &symmetric, &start);
    }
    let into = into.unwrap_or(1);
    let count = (arguments.duration * arguments.rate).round().max(1.0);
    let times = (0..=count as usize).map(|k| k as f64 * arguments.duration / count);
    let samples = sample(&subject, &arguments.method, &start, times.collect())?;
    let forms = FORMS.iter();
    let mut forms: Vec<_> = forms.filter_map(|form| symmetric.by_form(*form)).collect();
    let mut workspace = Workspace::new();
    let mut transfers = vec![Transfer::default(); names.len()];
    let [mut coordinates, mut momenta] = [(); 2].map(|()| vec![0.0; symmetric.links()]);
    let mut rows: Vec<[Transfer<f64>; FORMS.len()]> = Vec::with_capacity(samples.times.len());
    let mut causes: Vec<[Transfer<f64>; CAUSES.len()]> = Vec::new();
    for state in &samples.states {
        let (theta, omega) = state.split_at(symmetric.links());
        let given = StateInput::Absolute { theta, omega };
        symmetric.coordinates(&mut workspace, given, &mut coordinates);
        symmetric.momenta(&mut workspace, given, &mut momenta);
        let mut row = [Transfer::default(); FORMS.len()];
        for (form, own) in forms.iter_mut().zip(&mut row) {
            form.transfers([&coordinates, &momenta], &mut transfers);
            *own = transfers.get(into).copied().unwrap_or_default();
        }
        rows.push(row);
        if symmetric.has_unequal_copies() {
            let mut cause = [Transfer::default(); CAUSES.len()];
            symmetric.growth(&mut workspace, given, &mut transfers);
            cause[0] = transfers.get(into).copied().unwrap_or_default();
            symmetric.forcing(&mut workspace, given, &mut transfers);
            cause[1] = transfers.get(into).copied().unwrap_or_default();
            causes.push(cause);
        }
    }
    let series = TransferSeries {
        title: format!("{}: W into {}", subject.name, names[into]),
        times: &samples.times,
        rows: &rows,
        causes: &causes,
    };
    if series.largest() == 0.0 {
        return Err(nothing_transferred(names[into]));
    }
    job.print(&series.report())?;
    series.write(job)?;
    job.chart_over_time("transfer", &series.chart())
}

/// Returns the error for a motion whose copies start and stay in phase: W is zero, so that errors
/// relative to it are undefined.
fn nothing_transferred(sector: &str) -> Failure {
    Failure::Lacking {
        what: format!(
            "W into `{sector}` is zero at all times, because copies that start in phase stay in \
             phase: start them with different angles, by `--start apart` or `--start \
             NAME=DEG,..`"
        ),
    }
}

/// W along a motion, computed by every form.
struct TransferSeries<'a> {
    title: String,
    times: &'a [f64],
    rows: &'a [[Transfer<f64>; FORMS.len()]],
    /// Parts of the exact W, in the order of [`CAUSES`]; empty if all copies are identical.
    causes: &'a [[Transfer<f64>; CAUSES.len()]],
}

/// Names of the parts of the exact W between copies that differ: W of the mean tree, whose copies
/// have the means of their constants, and the rest.
const CAUSES: [&str; 2] = ["growth", "forcing"];

impl TransferSeries<'_> {
    fn column(&self, form: usize) -> Vec<f64> {
        self.rows.iter().map(|row| row[form].total()).collect()
    }

    /// Returns the differences between a form of W and the exact one.
    fn errors(&self, form: usize) -> Vec<f64> {
        let both = self.column(form).into_iter().zip(self.column(0));
        both.map(|(w, exact)| (w - exact).abs()).collect()
    }

    /// Largest exact W.
    fn largest(&self) -> f64 {
        self.column(0).iter().fold(0.0, |most, w| most.max(w.abs()))
    }

    fn report(&self) -> String {
        let (largest, end) = (self.largest(), self.times.last().unwrap_or(&0.0));
        let mut text = format!(
            "{} over {end} s, at most {largest:.4e} W\n\n{:18}{:>24}{:>24}\n",
            self.title, "form", "largest error (W)", "part of the largest W"
        );
        for (form, name) in FORMS.iter().enumerate().skip(1) {
            let worst = self.errors(form).into_iter().fold(0.0, f64::max);
            let name = name.to_string();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{name:18}{worst:24.4e}{:24.4e}", worst / largest);
        }
        text.push_str("(angle order 1 is the published form)\n");
        for (cause, name) in CAUSES.iter().enumerate() {
            let parts = self.causes.iter().map(|own| own[cause].total().abs());
            if let Some(most) = parts.reduce(f64::max) {
                let _ = writeln!(text, "{name}: at most {most:.4e} W");
            }
        }
        if !self.causes.is_empty() {
            text.push_str(
                "(the copies differ: growth is W between equal copies of mean constants, forcing \
                 the rest)\n",
            );
        }
        text
    }

    fn write(&self, job: &Job) -> Result<(), Failure> {
        let mut columns = vec![Column::new("time", "s")];
        let names = FORMS.iter().map(ToString::to_string);
        let is_split = !self.causes.is_empty();
        let causes = CAUSES.iter().filter(|_| is_split).map(ToString::to_string);
        for name in names.chain(causes) {
            columns.push(Column::new(format!("W_K {name}"), "W"));
            columns.push(Column::new(format!("W_P {name}"), "W"));
        }
        job.csv("transfer.csv", &columns, |csv| {
            for (place, (time, row)) in self.times.iter().zip(self.rows).enumerate() {
                let causes = self.causes.get(place).into_iter().flatten();
                let parts = row.iter().chain(causes);
                let parts = parts.flat_map(|w| [w.kinetic, w.potential]);
                csv.row(std::iter::once(*time).chain(parts).map(Cell::from))?;
            }
            Ok(())
        })
    }

    fn chart(&self) -> Chart {
        let forms = || FORMS.iter().enumerate();
        let panel = Panel::new(Axis::linear("W (W)")).zero_line();
        // Beyond order 2 lines cover the exact one.
        let panel = forms().take(3).fold(panel, |panel, (form, name)| {
            panel.line(name.to_string(), self.times, &self.column(form))
        });
        let is_split = !self.causes.is_empty();
        let causes = CAUSES.iter().enumerate().filter(|_| is_split);
        let panel = causes.fold(panel, |panel, (cause, name)| {
            let own = self.causes.iter().map(|own| own[cause].total());
            panel.line(*name, self.times, &own.collect::<Vec<_>>())
        });
        let largest = self.largest().max(f64::MIN_POSITIVE);
        let axis = Axis::log("|W − exact| (W)").range(1e-8 * largest, 10.0 * largest);
        let errors = forms()
            .skip(1)
            .fold(Panel::new(axis), |panel, (form, name)| {
                let errors: Vec<f64> = self
                    .errors(form)
                    .into_iter()
                    .map(|e| e.max(1e-99))
                    .collect();
                panel.line(name.to_string(), self.times, &errors)
            });
        let end = self.times.last().copied().unwrap_or(0.0);
        let x = Axis::linear("time (s)").range(0.0, end);
        let chart = Chart::new(verbatim(&self.title), x)
            .panel(panel)
            .panel(errors);
        chart.size(900.0, 640.0)
    }
}
