//! The command line.

use branched_pendulum_codegen::program::Pass;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Expands the attribute #[branched_pendulum(...)] in a Rust source file, and shows how.
///
/// Ends with 0 where it is done, 1 where the source is wrong or a file cannot be read
/// or written, 2 for a wrong command line, 3 where `check` finds a stale file.
#[derive(Parser)]
#[command(
    name = "cargo-branched-pendulum",
    bin_name = "cargo branched-pendulum",
    version,
    verbatim_doc_comment,
    disable_help_subcommand = true
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) action: Action,
}

/// What the tool is asked for.
#[derive(Subcommand)]
pub(crate) enum Action {
    /// Writes the source with every attribute expanded. Everything but the attributed structs is
    /// copied as it stands; imports of the attribute itself are left out.
    #[command(verbatim_doc_comment)]
    Expand {
        #[command(flatten)]
        source: Source,
        /// writes to a file [default: the standard output]
        #[arg(long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Compares what would be written with a committed file; ends with 3 where that is stale.
    Check {
        #[command(flatten)]
        source: Source,
        /// the committed file
        committed: PathBuf,
        /// the file is what `emit` writes of this kind
        #[arg(long, value_name = "OUTPUT")]
        emit: Option<Output>,
    },
    /// Shows a stage of the derivation.
    Stage {
        /// the stage
        stage: Stage,
        #[command(flatten)]
        source: Source,
    },
    /// Writes functions in another language, the formulas, or a part of the code.
    Emit {
        /// what is written
        emit: Output,
        #[command(flatten)]
        source: Source,
        /// writes to a file [default: the standard output]
        #[arg(long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// The source, and how it is compiled.
#[derive(Args)]
pub(crate) struct Source {
    /// Rust file with attributed structs; - for the standard input
    #[arg(value_name = "SOURCE")]
    pub(crate) path: PathBuf,
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
