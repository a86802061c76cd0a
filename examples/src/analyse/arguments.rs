//! The command line.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};

use crate::branched_double::Friction;
use branched_pendulum_program::frame::command_line::number;
use branched_pendulum_program::measured_file::MeasuredFile;

/// From measured angles of a pendulum to its energy and power with their errors: of the
/// paper's pendulum H_d and W, of a chain of two links H and the power of friction. The
/// file is a table of angles against time, or of two dots a link as Tracker or DeepLabCut
/// write them; without one a camera before the paper's pendulum is simulated, whose truth
/// is known.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "analyse", version, verbatim_doc_comment)]
pub struct Arguments {
    /// The file.
    #[command(flatten)]
    pub measured: MeasuredFile,
    /// what the angles are those of
    #[arg(long, value_enum, value_name = "TREE", default_value = "branched")]
    pub pendulum: Tree,
    /// constants of the chain with all laws of friction, a table of names and values (JSON),
    /// as `identify` writes it; without it those that the authors of its measurements fitted
    #[arg(verbatim_doc_comment, long, value_name = "FILE")]
    pub parameters: Option<PathBuf>,
    /// takes every Nth row of the file
    #[arg(long, value_name = "N", default_value = "1", value_parser = rows)]
    pub every: usize,
    /// use the equations of motion: smaller errors if they hold
    #[arg(long)]
    pub model: bool,
    /// polynomials near each time, a check of what smoothness says
    #[arg(long, conflicts_with = "model")]
    pub polynomials: bool,
    /// Friction in the equations of motion.
    #[command(flatten)]
    pub friction: Friction,
    /// draws from the motions that the data allow, 20 to 10000
    #[arg(long, value_name = "N", default_value = "200", value_parser = clap::value_parser!(u32).range(20..=10_000))]
    pub draws: u32,
    /// simulated: initial angle of the parent, degrees from 0 to 90
    #[arg(long, value_name = "DEG", default_value = "47.8", value_parser = number(0.0..=90.0, "°"))]
    pub angle: f64,
    /// simulated: initial difference of the children, rad from 0 to 1
    #[arg(long, value_name = "RAD", default_value = "0.01", value_parser = number(0.0..=1.0, "rad"))]
    pub difference: f64,
    /// simulated: length of the record, s from 0.5 to 100
    #[arg(long, value_name = "S", default_value = "4", value_parser = number(0.5..=1e2, "s"))]
    pub duration: f64,
    /// simulated: pictures a second, 10 to 1e4
    #[arg(long, value_name = "HZ", default_value = "240", value_parser = number(1e1..=1e4, "Hz"))]
    pub rate: f64,
    /// simulated: error of a dot's place, m from 1e-6 to 0.01
    #[arg(long, value_name = "M", default_value = "2e-4", value_parser = number(1e-6..=1e-2, "m"))]
    pub noise: f64,
    /// simulated: friction in the children's pivots that the equations lack, N m s
    #[arg(long, value_name = "C", default_value = "0", value_parser = number(0.0..=1.0, "N m s"))]
    pub unmodelled: f64,
    /// simulated: the parent is longer than assumed by so much, m
    #[arg(long, value_name = "M", default_value = "0", value_parser = number(-0.1..=0.1, "m"), allow_hyphen_values = true)]
    pub longer: f64,
    /// simulated: the first child's dots are turned from its line by so much, degrees
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = number(-10.0..=10.0, "°"), allow_hyphen_values = true)]
    pub turned: f64,
    /// seed of all random numbers
    #[arg(long, value_name = "N", default_value = "1")]
    pub seed: u64,
}

/// Trees that can be analysed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Tree {
    /// The paper's: a parent with two equal children.
    Branched,
    /// A chain of two links.
    Chain,
}

impl Tree {
    /// Options of the constants that are assumed.
    pub fn constants(self) -> &'static str {
        match self {
            Self::Branched => "--friction-root, --friction-children",
            Self::Chain => "--parameters",
        }
    }
}

impl Arguments {
    /// Friction of the simulated apparatus.
    pub fn real_friction(&self) -> Friction {
        Friction {
            children: self.friction.children + self.unmodelled,
            ..self.friction
        }
    }
}

impl Default for Arguments {
    fn default() -> Self {
        Self::parse_from(["analyse"])
    }
}

impl branched_pendulum_program::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("analyse-output");

    fn check(&self) -> Result<(), String> {
        self.measured.check()?;
        if self.pendulum == Tree::Chain && self.measured.file.is_none() {
            return Err("a camera is simulated before the branched pendulum alone: \
                 --pendulum chain needs a file"
                .to_owned());
        }
        if self.pendulum == Tree::Chain && !self.friction.is_zero() {
            return Err("friction of the chain stands among its --parameters".to_owned());
        }
        if self.pendulum == Tree::Branched && self.parameters.is_some() {
            return Err("--parameters are those of the chain".to_owned());
        }
        Ok(())
    }
}

fn rows(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(rows @ 1..=100_000) => Ok(rows),
        _ => Err("a whole number from 1 to 100000".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::Arguments;
    use branched_pendulum_program::frame::command_line as program;

    #[test]
    fn lists_are_one_option() {
        assert!(Arguments::try_parse_from(["analyse", "swing.csv", "--every", "0"]).is_err());
        // All of a list stands in the record of a run.
        let words = ["analyse", "swing.csv", "--columns", "a,b,c"].map(Into::into);
        let read = program::parse::<Arguments>(words).unwrap();
        assert_eq!(read.arguments.measured.columns, ["a", "b", "c"]);
        assert_eq!(read.values["columns"], "a,b,c");
    }
}
