//! Search for parameters at which frequencies, thresholds and growth rates have given values.

mod report;
mod text;

use branched_pendulum::analysis::normal_form::NormalFormOptions;
use branched_pendulum_measure::design::{DesignError, DesignTarget, DesignVariable, Goal};
use branched_pendulum_trees::{DesignSettings, TreeDesign};
use clap::Parser;

use self::report::DesignReport;
use super::differences::PairArguments;
use crate::Failure;
use crate::frame::command_line::{number, numbers, parts};
use crate::frame::{Charts, Job};
use crate::release::ReleaseArguments;
use crate::subject::TreeArguments;

/// Which parameters give a tree these frequencies, this threshold, this growth rate? Searches
/// within bounds from several starts, prints the parameters with the derivatives of the targets,
/// and writes the designed tree as text. Nothing is simulated.
///
/// Targets are `mode_1`, `mode_2`, ..., the frequencies of all modes in the order of `modes` (Hz);
/// `f_1`, ... of the modes in phase and `d_1`, ... of the difference between copies, as in `theory`
/// (`f_d` is `d_1` if there is one, `f_+` and `f_-` are `f_1` and `f_2` if there are two);
/// `threshold`, or `window`: the smallest angle of release of `--link` from which a difference
/// grows (degrees); and `growth`: its growth rate after the release `--start`, less the decay by
/// friction (1/s). Both are by the normal form, with its error bar.
///
/// If more parameters vary than there are targets, the solution nearest to the present values is
/// reported. If no parameters within the bounds reach the targets, the nearest ones are reported,
/// and the command fails.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum design", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    /// parameters of the description that vary, each with its bounds, in SI units
    #[arg(long, required = true, value_name = "NAME=FROM:TO[,..]", value_parser = variables)]
    // By its full path, clap takes each for one value.
    vary: Vec<::std::vec::Vec<DesignVariable>>,
    /// targets: `f_d=1.26,threshold=20`, with `>=` or `<=` in place of `=` for a limit
    #[arg(long, required = true, value_name = "NAME=VALUE[,..]", value_parser = targets)]
    target: Vec<::std::vec::Vec<DesignTarget>>,
    #[command(flatten)]
    release: ReleaseArguments,
    #[command(flatten)]
    pair: PairArguments,
    /// link whose angle of release is the threshold; by default the root. The other links have
    /// their angles by `--start`
    #[arg(verbatim_doc_comment, long, value_name = "LINK")]
    link: Option<String>,
    /// angles between which the threshold is located, degrees from 0 to 180; FROM:TO:STEP for a
    /// range
    #[arg(
        verbatim_doc_comment,
        long = "angles",
        id = "angles",
        value_name = "DEG[,DEG]...",
        default_value = "0.25:60:0.25",
        value_parser = numbers(0.0..=180.0, "degrees")
    )]
    angles_deg: ::std::vec::Vec<f64>,
    /// growth rate from which on a difference counts as growing, 1/s, in addition to the decay by
    /// friction
    #[arg(verbatim_doc_comment, long, value_name = "RATE", default_value = "0.02", value_parser = number(0.0..=10.0, "1/s"))]
    least: f64,
    /// degree of the normal form: 4, 6, 8, 10 or 12
    #[arg(long, value_name = "DEGREE", default_value_t = 8)]
    degree: u32,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("design-output");
    const CHARTS: Charts = Charts::None;
}

/// Searches for the parameters, prints them, and writes tables and the designed tree.
///
/// # Errors
/// [`Failure`]; also, after the report, if the targets are not reached.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let described = arguments.tree.described()?;
    described.note(job)?;
    let variables = arguments.vary.concat();
    let mut values = described.known();
    for own in &variables {
        if values.iter().all(|(name, _)| *name != own.name) {
            values.push((&own.name, own.present));
        }
    }
    let subject = described.subject(&values)?;
    let copies = match arguments.pair.copies(&subject) {
        Err(error) if arguments.pair.is_given() => return Err(error),
        copies => copies.ok(),
    };
    let settings = DesignSettings {
        copies,
        release: arguments.release.state(&subject)?,
        scanned: match &arguments.link {
            Some(name) => subject.links_named(name)?,
            None => vec![0],
        },
        angles_deg: arguments.angles_deg.clone(),
        least: arguments.least,
        form: NormalFormOptions {
            degree: arguments.degree,
            ..NormalFormOptions::default()
        },
    };
    let design = TreeDesign::new(
        described.description.clone(),
        &values,
        variables.clone(),
        arguments.target.concat(),
        settings,
    )?;
    let progress = job.progress(1);
    progress.begin("search");
    let found = progress.ticking(|| design.run())?;
    progress.next();
    let report = DesignReport {
        name: &described.name,
        design: &design,
        found: &found,
        values: design.values(&found.parameters).unwrap_or_default(),
    };
    job.print(&report.text())?;
    report.write(job)?;
    if let Some(cause) = found.cause(design.search().variables()) {
        return Err(Failure::Design(DesignError::NotReached { cause }));
    }
    let tree = design.tree(&found.parameters);
    let designed = described.with_tree(tree.map_err(|source| described.refused(source))?);
    designed.record(job)?;
    match text::written(&designed) {
        Some(text) => job.write("tree.txt", text.as_bytes()),
        None => job.print(
            "The tree is not written to `tree.txt`, because a name in it means both a \
             parameter and a link: give the file run.json by `--parameters`, next to `--tree`.\n",
        ),
    }
}

fn variables(text: &str) -> Result<Vec<DesignVariable>, String> {
    let variable = |part: &str| {
        let (name, range) = part.split_once('=')?;
        let (from, to) = range.split_once(':')?;
        let [from, to] = [from, to].map(|own| own.trim().parse::<f64>().ok());
        Some(DesignVariable::new(name.trim(), [from?, to?]))
    };
    let wrong = |part: &str| {
        format!("`{part}` is not a range: write `NAME=FROM:TO`, as in `mass_2=0.05:0.2`")
    };
    let all = parts(text).map(|part| variable(part).ok_or_else(|| wrong(part)));
    all.collect()
}

fn targets(text: &str) -> Result<Vec<DesignTarget>, String> {
    let target = |part: &str| {
        let place = part.find(['<', '>', '='])?;
        let (name, goal) = part.split_at(place);
        let (kind, value): (fn(f64) -> Goal, &str) = match goal {
            own if own.starts_with(">=") => (Goal::AtLeast, &own[2..]),
            own if own.starts_with("<=") => (Goal::AtMost, &own[2..]),
            own if own.starts_with('=') => (Goal::Equal, &own[1..]),
            _ => return None,
        };
        let value = value.trim().parse::<f64>().ok()?;
        Some(DesignTarget::new(name.trim(), kind(value)))
    };
    let wrong = |part: &str| {
        format!(
            "`{part}` is not a target: write `NAME=VALUE`, as in `f_d=1.26`, or `NAME>=VALUE` or \
             `NAME<=VALUE` for a limit"
        )
    };
    let all = parts(text).map(|part| target(part).ok_or_else(|| wrong(part)));
    all.collect()
}
