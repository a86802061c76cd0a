//! Command-line arguments.

use branched_pendulum_codegen::program::Pass;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Expands the attribute #[branched_pendulum(...)] in a Rust source file, and shows how.
///
/// Exit codes: 0 on success, 1 if the source is wrong or a file cannot be read or written, 2 for a
/// wrong command line, 3 if `check` finds an outdated file.
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

/// The requested action.
#[derive(Subcommand)]
pub(crate) enum Action {
    /// Writes the source with every attribute expanded. All other code is copied unchanged, except
    /// that imports of the attribute itself are left out.
    #[command(verbatim_doc_comment)]
    Expand {
        #[command(flatten)]
        source: Source,
        /// output file [default: the standard output]
        #[arg(long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Compares a committed file with the present expansion; exits with 3 if the file is outdated.
    Check {
        #[command(flatten)]
        source: Source,
        /// the committed file
        committed: PathBuf,
        /// kind of output that the committed file holds, as for `emit`
        #[arg(long, value_name = "OUTPUT")]
        emit: Option<Output>,
    },
    /// Prints one stage of the derivation.
    Stage {
        /// stage to print
        stage: Stage,
        #[command(flatten)]
        source: Source,
    },
    /// Writes functions in another language, the formulas, or a part of the code.
    Emit {
        /// kind of output
        emit: Output,
        #[command(flatten)]
        source: Source,
        /// output file [default: the standard output]
        #[arg(long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// The source file, and options of its compilation.
#[derive(Args)]
pub(crate) struct Source {
    /// Rust file with attributed structs; - for the standard input
    #[arg(value_name = "SOURCE")]
    pub(crate) path: PathBuf,
    /// leaves out one optimisation pass, for comparison
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
    /// the code to emit, as a flat list of operations
    Program,
    /// operation counts without each of the optimisation passes
    Passes,
}

/// Kinds of output other than the expanded model.
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
    /// the equations of a single link, in Rust, if the code has loops over links
    Equations,
}

fn pass() -> impl TypedValueParser<Value = Pass> {
    PossibleValuesParser::new(Pass::ALL.map(Pass::name))
        .try_map(|name| Pass::named(&name).ok_or("no such pass"))
}
