//! Prediction, by the resonant normal form, of releases from which differences between copies grow.

mod report;

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use clap::Parser;

use self::report::{TheoryCase, TheoryReport};
use super::differences::{PairArguments, differences_of};
use super::plane::{AxisValues, MapPlane};
use super::predicted::Theory;
use crate::Failure;
use crate::frame::command_line::number;
use crate::frame::{Charts, Job};
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// From which releases do differences between copies grow, by theory? Expands the Hamiltonian
/// about the equilibrium, normalises it, and reports the frequencies, the near-resonances and
/// the tongues of growth along lines of releases. Nothing is simulated.
///
/// Every number has an error bar: the difference between the results for the two highest degrees.
/// If they differ by more than 0.5 % of a frequency, no prediction is made.
///
/// With a parameter on the axis of `--x` the tongue is the range of its values at which the
/// release grows. With `--vary` the lines are repeated for each value of a parameter: for which
/// value does a tongue lie at a given release?
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum theory", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    pair: PairArguments,
    /// axis along which tongues are found: a link with its angles in degrees, or a parameter with
    /// its values; the edges of tongues are found between neighbouring values
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "NAME=FROM:TO:STEP",
        default_value = "child=-60:60:0.5",
        value_parser = AxisValues::read
    )]
    x: AxisValues,
    /// lines: values of another link or parameter, one line each
    #[arg(long, value_name = "NAME=VALUE[,VALUE]...", default_value = "parent=10,20,30", value_parser = AxisValues::read_values)]
    at: AxisValues,
    /// repeats the lines with each of these values of a parameter, as in `mass=0.05:0.2:0.005`
    #[arg(long, value_name = "NAME=FROM:TO:STEP", value_parser = AxisValues::read)]
    vary: Option<AxisValues>,
    /// degree of the Hamiltonian: 4, 6, 8, 10 or 12
    #[arg(long, value_name = "DEGREE", default_value_t = 8)]
    degree: u32,
    /// largest mismatch at which resonances of order 4 are kept, relative to the lowest frequency
    /// of a difference; it is halved for each two further orders
    #[arg(verbatim_doc_comment, long, value_name = "PART", default_value = "0.15", value_parser = number(0.0..=0.5, ""))]
    bound: f64,
    /// smallest growth rate that counts as a tongue, 1/s, in addition to the decay by friction
    #[arg(long, value_name = "RATE", default_value = "0", value_parser = number(0.0..=10.0, "1/s"))]
    least: f64,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("theory-output");
    const CHARTS: Charts = Charts::None;

    fn check(&self) -> Result<(), String> {
        let varied = self.vary.as_ref().map(|own| &own.name);
        let both = |one: &str, other: &str, name: &str| {
            Err(format!(
                "`{one}` and `{other}` are both `{name}`: name another one"
            ))
        };
        match (&self.x.name, &self.at.name) {
            (x, at) if x == at => both("--x", "--at", x),
            (x, _) if Some(x) == varied => both("--x", "--vary", x),
            (_, at) if Some(at) == varied => both("--at", "--vary", at),
            (_, _) => Ok(()),
        }
    }
}

/// Derives the normal form and writes its predictions; after Ctrl-C, the completed lines are
/// written.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let copies = arguments.pair.copies(&subject)?;
    let start = arguments.release.state(&subject)?;
    let theory = Theory {
        options: NormalFormOptions {
            degree: arguments.degree,
            bound: arguments.bound,
            ..NormalFormOptions::default()
        },
        copies: &copies,
        name: &subject.name,
        least: arguments.least,
    };
    let subjects = arguments.subjects(&subject)?;
    let planes = subjects
        .iter()
        .map(|(_, subject)| MapPlane::new(subject, start.clone(), [&arguments.x, &arguments.at]));
    let planes = planes.collect::<Result<Vec<_>, _>>()?;
    let progress = job.progress(planes.len() * arguments.at.values().len());
    progress.begin("lines");
    let mut cases = Vec::new();
    for ((value, subject), plane) in subjects.iter().zip(&planes) {
        if job.is_interrupted() && !cases.is_empty() {
            break;
        }
        let mut case = TheoryCase {
            value: *value,
            form: theory.form(&subject.tree)?,
            decay: differences_of(&subject.tree, &copies, Vec::new(), 1.0)?.decay(),
            plane,
            lines: Vec::new(),
        };
        for line in &plane.lines(&arguments.at)? {
            if job.is_interrupted() {
                break;
            }
            case.lines.push(theory.along(plane, line, 0)?);
            job.take_interruption();
            progress.advance(1.0);
        }
        cases.push(case);
    }
    let report = TheoryReport {
        name: &subject.name,
        varied: arguments.vary.as_ref().map(|own| own.name.as_str()),
        least: arguments.least,
        cases: &cases,
    };
    job.print(&report.text())?;
    if let [case] = cases.as_slice() {
        let form = case.form.form();
        let resonances = form.resonances().iter().map(ToString::to_string);
        job.report("resonances", resonances.collect::<Vec<String>>());
        job.report("frequencies_hz", form.linear_frequencies_hz());
    }
    report.write(job)
}

impl Arguments {
    /// Returns the trees with the values of the varied parameter.
    fn subjects(&self, subject: &Subject) -> Result<Vec<(Option<f64>, Subject)>, Failure> {
        let Some(varied) = &self.vary else {
            return Ok(vec![(None, subject.clone())]);
        };
        let values = varied.values().iter();
        let subjects = values.map(|value| {
            let changed = Subject {
                tree: subject.with(&varied.name, *value)?,
                ..subject.clone()
            };
            Ok((Some(*value), changed))
        });
        subjects.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Arguments as _;

    #[test]
    fn one_axis_is_not_two() {
        let words = ["theory", "--x", "child=0:10:1", "--at", "child=3"];
        let arguments = Arguments::try_parse_from(words).unwrap();
        assert!(arguments.check().unwrap_err().contains("both `child`"));
        let words = ["theory", "--vary", "mass=1:2:1", "--x", "mass=1:2:1"];
        let arguments = Arguments::try_parse_from(words).unwrap();
        assert!(arguments.check().unwrap_err().contains("both `mass`"));
    }
}
