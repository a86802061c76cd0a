//! The cheapest model, method and setting that is right for what is asked of a tree.

use std::cell::RefCell;

use branched_pendulum::approximate::{Approximation, Linear};
use branched_pendulum::prelude::*;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Workspace;
use branched_pendulum::transfer::{Given, SymmetricTree};
use branched_pendulum_advice::{Advice, Advisor, Candidates, ModelForm, TimeLimit, Wanted};
use branched_pendulum_data::{Cell, Column};
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::frame::command_line::number;
use crate::release::ReleaseArguments;
use crate::subject::{Subject, TreeArguments};

/// Which model, method, tolerance or step and scalar is the cheapest that is right for a
/// tree, on this machine? Measures all of them and says what to take, how wrong it is and
/// what it costs, what comes next, and why what is cheaper will not do.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum advise", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
    #[command(flatten)]
    release: ReleaseArguments,
    /// outputs with their largest errors, with commas between: angles (rad), energy (J),
    /// pixels (of 1000 a metre), transfer (W, into the first difference between copies)
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "OUTPUT:ERROR,..",
        default_value = "angles:1e-6",
        value_parser = outputs
    )]
    // By its full path, clap takes it for one value.
    right: ::std::vec::Vec<(Output, f64)>,
    /// time followed, s from 0.1 to 1000
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.1..=1e3, "s"))]
    duration: f64,
    /// samples, or frames, in a second, from 0.1 to 1000
    #[arg(long, value_name = "HZ", default_value = "10", value_parser = number(0.1..=1e3, "Hz"))]
    rate: f64,
    /// releases, 1 to 1000, whose first angles differ by up to 0.6°: several may go at once in
    /// the lanes of vector registers
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u32).range(1..=1000)
    )]
    starts: u32,
    /// largest time that may be taken: `step:` or `sample:` and µs
    #[arg(long, value_name = "LIMIT", value_parser = limit)]
    limit: Option<TimeLimit>,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = None;
}

/// An output that must be right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// All angles.
    Angles,
    /// The energy.
    Energy,
    /// The ends of all links.
    Pixels,
    /// W into the first difference between copies.
    Transfer,
}

const OUTPUTS: [(&str, Output); 4] = [
    ("angles", Output::Angles),
    ("energy", Output::Energy),
    ("pixels", Output::Pixels),
    ("transfer", Output::Transfer),
];

fn outputs(text: &str) -> Result<Vec<(Output, f64)>, String> {
    let one = |part: &str| {
        let (name, tolerance) = part
            .split_once(':')
            .ok_or_else(|| format!("`{part}` is no output and its largest error: `angles:1e-6`"))?;
        let output = OUTPUTS.iter().find(|(word, _)| *word == name);
        let (_, output) = output.ok_or_else(|| {
            let words = OUTPUTS.map(|(word, _)| word).join(", ");
            format!("there is no output `{name}` (outputs: {words})")
        })?;
        Ok::<_, String>((*output, number(1e-14..=1e3, "")(tolerance)?))
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

/// Pixels a metre.
const PIXELS: f64 = 1000.0;

/// Largest drift of the energy beyond the horizon of chaos, J.
const DRIFT: f64 = 1e-6;

/// Largest deviation of releases, rad.
const DEVIATION: f64 = 0.01;

/// Asks for advice and writes all that was measured.
///
/// # Errors
/// [`Failure`]; [`Failure::Tree`] for the transfer of a tree without copies.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job);
    let tree = &subject.tree;
    let start = arguments.release.state(&subject)?;
    let wants_transfer = arguments
        .right
        .iter()
        .any(|(output, _)| *output == Output::Transfer);
    let symmetric = match wants_transfer {
        true => Some(
            tree.symmetric()
                .map_err(|source| Failure::tree(&subject.name, source))?,
        ),
        false => None,
    };
    let system = AbsoluteAngles(tree);
    let count = (arguments.duration * arguments.rate).round().max(1.0) as u32;
    let sample = |index| arguments.duration * f64::from(index) / f64::from(count);
    let mut advisor = Advisor::new(&system).at((1..=count).map(sample).collect());
    for index in 0..arguments.starts {
        let part = f64::from(index) / f64::from(arguments.starts.max(2) - 1);
        let mut start = start.clone();
        start.values[0] += DEVIATION * part;
        advisor = advisor.start(start);
    }
    let driven = tree.drive(0.0).is_some();
    // Rates of which no two are equal: friction in every pivot takes power from them.
    let rates: Vec<f64> = (1..=tree.links()).map(|link| link as f64).collect();
    if !driven && tree.friction_power(&rates) == 0.0 {
        advisor = advisor.conserved(Wanted::energy(tree, DRIFT));
    }
    for &(output, tolerance) in &arguments.right {
        advisor = advisor.wanted(match (output, &symmetric) {
            (Output::Energy, _) => Wanted::energy(tree, tolerance),
            (Output::Pixels, _) => Wanted::pixels(tree, PIXELS, tolerance),
            (Output::Transfer, Some(symmetric)) => transfer(symmetric, tolerance),
            (Output::Angles | Output::Transfer, _) => Wanted::angles(tolerance),
        });
    }
    if let Some(limit) = arguments.limit {
        advisor = advisor.within(limit);
    }
    let progress = job.progress(1);
    progress.begin(&subject.name);
    let candidates = candidates(&subject, arguments, &start);
    let advice = progress
        .ticking(|| advisor.advise(&candidates))
        .map_err(Failure::advice)?;
    progress.next();
    job.print(&format!("{}\n\n{advice}", subject.name))?;
    if let Some(chosen) = advice.chosen() {
        job.report("choice", advice.describe(chosen));
        job.report("error over tolerance", chosen.ratio());
        job.report("seconds", chosen.seconds);
    }
    write(job, &advice)
}

fn transfer(symmetric: &SymmetricTree<f64>, tolerance: f64) -> Wanted<'_> {
    let memory = RefCell::new((
        Workspace::new(),
        vec![Transfer::default(); symmetric.sectors().len()],
    ));
    Wanted::new("transfer", "W", tolerance, move |_, state, out| {
        let (workspace, transfers) = &mut *memory.borrow_mut();
        let (theta, omega) = state.split_at(state.len() / 2);
        let given = Given::Absolute { theta, omega };
        symmetric.exact_transfers(workspace, given, transfers);
        out.extend(transfers.get(1).map(|transfer| transfer.total()));
    })
}

/// The tree as it is, and its linear model about its rest where it has one.
fn candidates<'a>(
    subject: &'a Subject,
    arguments: &Arguments,
    start: &State<f64>,
) -> Candidates<'a> {
    let tree = &subject.tree;
    let full = ModelForm::new("full");
    let mut candidates = Candidates::new();
    let frame = 1.0 / arguments.rate;
    let rest = tree.equilibrium(&start.values[..tree.links()]);
    // What has no linear model is not asked for one.
    if let Some(linear) = rest.ok().and_then(|rest| Linear::about(tree, &rest).ok())
        && let (Ok(mut double), Ok(mut single)) =
            (linear.frames::<f64>(frame), linear.frames::<f32>(frame))
    {
        let form = ModelForm::new("linear");
        candidates = candidates
            .frames(&form, "f64", frame, move |state: &mut [f64]| {
                double.step(state)
            })
            .frames(&form, "f32", frame, move |state: &mut [f32]| {
                single.step(state)
            });
    }
    candidates = candidates.rates(&full, AbsoluteAngles(tree));
    match arguments.starts {
        1 => candidates,
        _ => candidates.lanes(&full, AbsoluteAngles(tree)),
    }
}

fn write(job: &Job, advice: &Advice) -> Result<(), Failure> {
    let columns = [
        Column::new("model", ""),
        Column::new("method", ""),
        Column::new("scalar", ""),
        Column::new("lanes", ""),
        Column::new("tolerance or step", ""),
        Column::new("error over tolerance", ""),
        Column::new("time", "s"),
    ];
    job.csv("advice.csv", &columns, |csv| {
        for run in &advice.runs {
            let name = &advice.names[run.candidate];
            csv.row([
                Cell::from(name.model.as_str()),
                name.method.as_str().into(),
                name.scalar.into(),
                if name.in_lanes { "yes" } else { "no" }.into(),
                run.setting.into(),
                run.ratio().into(),
                run.seconds.into(),
            ])?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use branched_pendulum_advice::AdviceError;

    use crate::Failure;
    use crate::frame::messages;

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
