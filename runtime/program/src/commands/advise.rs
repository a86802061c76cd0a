//! Choice of the cheapest model, method and setting that computes the requested outputs of a tree
//! accurately enough.

use branched_pendulum::integrate::Method;
use branched_pendulum_advice::{
    Advice, AdviceError, TimeLimit, TreeOutput, TreeScene, UnknownOutput,
};
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::frame::command_line::number;
use crate::release::ReleaseArguments;
use crate::subject::TreeArguments;

/// Which model, method, tolerance or step, and number type is the cheapest that is accurate enough
/// for a tree, on this machine? Measures all candidates and reports the one to use, its error and
/// its cost, the runners-up, and why cheaper candidates fail.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum advise", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    /// outputs with their largest errors, separated by commas: angles (rad), energy (J),
    /// pixels (1000 per metre), transfer (W, into the first difference between copies)
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "OUTPUT:ERROR,..",
        default_value = "angles:1e-6",
        value_parser = outputs
    )]
    // By its full path, clap takes it for one value.
    right: ::std::vec::Vec<(TreeOutput, f64)>,
    /// duration of the motion, s from 0.1 to 1000
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.1..=1e3, "s"))]
    duration: f64,
    /// samples, or frames, per second, from 0.1 to 1000
    #[arg(long, value_name = "HZ", default_value = "10", value_parser = number(0.1..=1e3, "Hz"))]
    rate: f64,
    /// number of releases, 1 to 1000, whose first angles differ by up to 0.6°; several may be
    /// integrated at once in vector registers
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u32).range(1..=1000)
    )]
    starts: u32,
    /// largest computing time that is accepted: `step:` or `sample:` and the time in µs
    #[arg(long, value_name = "LIMIT", value_parser = limit)]
    limit: Option<TimeLimit>,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = None;
}

fn outputs(text: &str) -> Result<Vec<(TreeOutput, f64)>, String> {
    let one = |part: &str| {
        let (name, tolerance) = part.split_once(':').ok_or_else(|| {
            format!(
                "`{part}` is not an output with its largest error: write it as in \
                `angles:1e-6`"
            )
        })?;
        let output = name
            .parse()
            .map_err(|error: UnknownOutput| error.to_string())?;
        Ok::<_, String>((output, number(1e-14..=1e3, "")(tolerance)?))
    };
    text.split(',').map(one).collect()
}

fn limit(text: &str) -> Result<TimeLimit, String> {
    let wrong = || "must be `step:` or `sample:` and µs".to_owned();
    let (what, micros) = text.split_once(':').ok_or_else(wrong)?;
    let seconds = 1e-6 * number(1e-3..=1e9, "µs")(micros)?;
    match what {
        "step" => Ok(TimeLimit::Step(seconds)),
        "sample" => Ok(TimeLimit::Sample(seconds)),
        _ => Err(wrong()),
    }
}

/// Largest deviation of releases, rad.
const DEVIATION: f64 = 0.01;

/// Measures the candidates and writes the recommendation and all measurements.
///
/// # Errors
/// [`Failure`]; [`Failure::Tree`] if the energy transfer is requested of a tree without copies.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let start = arguments.release.state(&subject)?;
    let count = (arguments.duration * arguments.rate).round().max(1.0) as u32;
    let sample = |index| arguments.duration * f64::from(index) / f64::from(count);
    let released = (0..arguments.starts).map(|index| {
        let part = f64::from(index) / f64::from(arguments.starts.max(2) - 1);
        let mut start = start.clone();
        start.values[0] += DEVIATION * part;
        start
    });
    let scene = TreeScene {
        starts: released.collect(),
        times: (1..=count).map(sample).collect(),
        right: arguments.right.clone(),
        limit: arguments.limit,
    };
    let progress = job.progress(1);
    progress.begin(&subject.name);
    let mut advice =
        progress
            .ticking(|| scene.advise(&subject.tree))
            .map_err(|error| match error {
                AdviceError::Tree(source) => Failure::tree(&subject.name, source),
                error => Failure::advice(error),
            })?;
    progress.next();
    let best = advice.best_full();
    let command = best.map(|(run, method)| command(arguments, method, run.setting));
    advice.to_write = command.into_iter().collect();
    job.print(&format!("{}\n\n{advice}", subject.name))?;
    if let Some(chosen) = advice.chosen() {
        job.report("choice", advice.describe(chosen));
        job.report("error over tolerance", chosen.ratio());
        job.report("seconds", chosen.seconds);
    }
    let columns = Advice::COLUMNS.map(|(name, unit)| Column::new(name, unit));
    job.csv("advice.csv", &columns, |csv| {
        advice.rows::<Cell<'_>>().try_for_each(|row| csv.row(row))
    })
}

/// Returns the command line that integrates the motion by this method and setting.
fn command(arguments: &Arguments, method: Method, setting: f64) -> String {
    let Arguments {
        tree,
        release,
        duration,
        rate,
        ..
    } = arguments;
    let mut words = vec!["branched-pendulum simulate".to_owned()];
    let mut option = |name: &str, value: String| words.push(format!("--{name} {}", quoted(&value)));
    option("tree", tree.tree.clone());
    if let Some(file) = &tree.parameters {
        option("parameters", file.display().to_string());
    }
    let set = tree.set.iter().flatten();
    let set: Vec<String> = set.map(|(name, value)| format!("{name}={value}")).collect();
    if !set.is_empty() {
        option("set", set.join(","));
    }
    option("start", release.start.clone());
    if release.rates != "0" {
        option("rates", release.rates.clone());
    }
    option("duration", duration.to_string());
    option("rate", rate.max(1.0).to_string());
    option("method", method.to_string());
    option("tolerance", format!("{setting:e}"));
    words.join(" ")
}

/// Quotes a word for the shell if necessary.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-+./=,:".contains(c);
    match word.chars().all(is_plain) && !word.is_empty() {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use branched_pendulum_advice::AdviceError;

    use crate::Failure;
    use crate::frame::messages;

    #[test]
    fn words_of_a_command_are_quoted_for_a_shell() {
        for (word, expected) in [
            ("my tree.txt", "'my tree.txt'"),
            ("child=10,parent=-3.5", "child=10,parent=-3.5"),
            ("it's", r"'it'\''s'"),
            ("", "''"),
        ] {
            assert_eq!(super::quoted(word), expected);
        }
    }

    #[test]
    fn every_cause_is_told_once() {
        let cause = std::io::Error::other("the step is too small");
        let failure = Failure::advice(AdviceError::Reference(Box::new(cause)));
        let messages = messages(&failure);
        assert_eq!(messages.len(), 3, "{messages:?}");
        for (index, cause) in messages.iter().enumerate() {
            let is_told_before = messages[..index].iter().any(|above| above.contains(cause));
            assert!(!is_told_before, "{messages:?}");
        }
    }
}
