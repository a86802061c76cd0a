//! Command line of the program `advise`.

use branched_pendulum_advice::TimeLimit;
use clap::Parser;

use super::requests::{OutputName, Question, SceneName};
use branched_pendulum_frame::command_line::number;

/// Which model, method, tolerance or step and number type is the cheapest that is
/// accurate enough, on this machine? Measures all candidates for a scene and reports
/// the one to use, its error and its cost, the runners-up, and why cheaper ones fail.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "advise", version, verbatim_doc_comment)]
pub struct Arguments {
    /// the tree and its release
    #[arg(long, value_name = "SCENE", value_enum, default_value = "paper")]
    pub scene: SceneName,
    /// outputs with their largest errors, separated by commas: angles (rad),
    /// energy (J), pixels (1000 per metre), transfer (W; paper's tree only)
    #[arg(
        long,
        value_name = "OUTPUTS",
        default_value = "angles:1e-6",
        value_parser = read_outputs,
        verbatim_doc_comment
    )]
    pub right: RightOutputs,
    /// duration of the motion, s from 0.1 to 1000
    #[arg(long, value_name = "S", default_value = "10", value_parser = number(0.1..=1e3, "s"))]
    pub horizon: f64,
    /// samples, or frames, per second, from 0.1 to 1000
    #[arg(long, value_name = "HZ", default_value = "10", value_parser = number(0.1..=1e3, "Hz"))]
    pub rate: f64,
    /// number of releases, 1 to 1000; several may be integrated at once in
    /// vector registers
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = clap::value_parser!(u32).range(1..=1000),
        verbatim_doc_comment
    )]
    pub starts: u32,
    /// largest computing time that is accepted: `step:` or `sample:` and µs
    #[arg(long, value_name = "LIMIT", value_parser = read_limit)]
    pub limit: Option<Limit>,
    /// instead, draws accuracy against cost for three scenes; needs --output
    #[arg(long, requires = "output")]
    pub chart: bool,
    /// instead, answers twelve questions, and measures cheaper alternatives
    #[arg(long, conflicts_with = "chart")]
    pub audit: bool,
}

/// List of required outputs with their tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct RightOutputs(pub Vec<(OutputName, f64)>);

/// A limit on time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit(pub TimeLimit);

impl Arguments {
    /// Returns the question that the arguments describe.
    pub fn question(&self) -> Question {
        Question {
            scene: self.scene,
            outputs: self.right.0.clone(),
            horizon: self.horizon,
            rate: self.rate,
            starts: self.starts,
            limit: self.limit.map(|limit| limit.0),
        }
    }
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = None;

    fn check(&self) -> Result<(), String> {
        let of_paper = |(output, _): &(OutputName, f64)| *output == OutputName::Transfer;
        if self.scene != SceneName::Paper && self.right.0.iter().any(of_paper) {
            return Err("`transfer` is an output of `--scene paper` alone".to_owned());
        }
        Ok(())
    }
}

fn read_outputs(text: &str) -> Result<RightOutputs, String> {
    let one = |part: &str| {
        let (name, tolerance) = part.split_once(':').ok_or_else(|| {
            format!("`{part}` names no output with its largest error, such as `angles:1e-6`")
        })?;
        let output = OutputName::ALL.iter().find(|output| output.word() == name);
        let output = output.ok_or_else(|| {
            let words = OutputName::ALL.map(OutputName::word).join(", ");
            format!("there is no output `{name}` (outputs: {words})")
        })?;
        Ok::<_, String>((*output, number(1e-14..=1e3, "")(tolerance)?))
    };
    let outputs: Result<_, String> = text.split(',').map(one).collect();
    Ok(RightOutputs(outputs?))
}

fn read_limit(text: &str) -> Result<Limit, String> {
    let (what, micros) = text
        .split_once(':')
        .ok_or_else(|| "must be `step:` or `sample:` and µs".to_owned())?;
    let seconds = 1e-6 * number(1e-3..=1e9, "µs")(micros)?;
    match what {
        "step" => Ok(Limit(TimeLimit::Step(seconds))),
        "sample" => Ok(Limit(TimeLimit::Sample(seconds))),
        _ => Err("must be `step:` or `sample:` and µs".to_owned()),
    }
}
