//! The command line.

use branched_pendulum_codegen::program::Pass;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, ValueEnum};
use std::path::PathBuf;

/// Expands the attribute #[branched_pendulum(...)] in a Rust source file. Everything
/// but the attributed structs is copied as it stands; imports of the attribute itself
/// are left out.
///
/// Ends with 0 where it is done, 1 where the source is wrong or a file cannot be read
/// or written, 2 for a wrong command line, 3 where --check finds a stale file.
#[derive(Parser)]
#[command(name = "branched-pendulum", version, verbatim_doc_comment)]
pub(crate) struct Arguments {
    /// Rust file with attributed structs; - for the standard input
    pub(crate) source: PathBuf,
    /// writes the expanded source to a file [default: the standard output]
    #[arg(long, value_name = "FILE", conflicts_with = "check")]
    pub(crate) output: Option<PathBuf>,
    /// compares it with a file; ends with 3 where that is stale
    #[arg(long, value_name = "FILE", conflicts_with = "stage")]
    pub(crate) check: Option<PathBuf>,
    /// shows a stage in place of code
    #[arg(long)]
    pub(crate) stage: Option<Stage>,
    /// writes something else in place of the model: functions in another language, the
    /// formulas, a part of the code
    #[arg(long, value_name = "OUTPUT", conflicts_with = "stage")]
    pub(crate) emit: Option<Output>,
    /// leaves out a pass over programs, to compare
    #[arg(long, value_name = "PASS", value_parser = pass())]
    pub(crate) without: Option<Pass>,
}

/// A stage of the generator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Stage {
    /// the attribute as it was read
    Description,
    /// the validated tree
    Scene,
    /// the derived mechanics
    Mechanics,
    /// the code to write, as a flat program
    Program,
    /// the worth of the passes over programs
    Passes,
}

/// Output beside the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Output {
    /// C99
    C,
    /// Python with NumPy
    Numpy,
    /// Julia
    Julia,
    /// the formulas, as a LaTeX document
    Latex,
    /// the equations of one link alone, in Rust, where the code is loops
    Equations,
}

fn pass() -> impl TypedValueParser<Value = Pass> {
    PossibleValuesParser::new(Pass::ALL.map(Pass::name))
        .try_map(|name| Pass::named(&name).ok_or("no such pass"))
}
