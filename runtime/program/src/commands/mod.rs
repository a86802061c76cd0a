//! Subcommands of the command-line program, one module each.

pub mod advise;
pub mod analyse;
pub mod cascade;
pub mod describe;
pub mod design;
mod differences;
pub mod growth;
pub mod identify;
pub mod map;
pub mod methods;
pub mod modes;
mod plane;
mod predicted;
pub mod simulate;
pub mod theory;
pub mod transfer;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Arg, Command, value_parser};
use clap_complete::Shell;

use crate::Failure;
use crate::frame::{self, Arguments, Job};

/// Name of the command.
const NAME: &str = "branched-pendulum";

/// Name of the subcommand that prints shell completions and needs no tree.
const COMPLETIONS: &str = "completions";
const SHELL: &str = "shell";

/// A subcommand: its options, and the function that runs it with the words of the command line.
struct Subcommand {
    name: &'static str,
    command: Command,
    run: Box<dyn Fn(Vec<OsString>) -> ExitCode>,
}

fn subcommand<A: Arguments + 'static>(
    name: &'static str,
    run: fn(&A, &Job) -> Result<(), Failure>,
) -> Subcommand {
    Subcommand {
        name,
        command: A::command(),
        run: Box::new(move |words| frame::run(words, run)),
    }
}

fn subcommands() -> Vec<Subcommand> {
    vec![
        subcommand("describe", describe::run),
        subcommand("simulate", simulate::run),
        subcommand("modes", modes::run),
        subcommand("growth", growth::run),
        subcommand("map", map::run),
        subcommand("theory", theory::run),
        subcommand("design", design::run),
        subcommand("transfer", transfer::run),
        subcommand("cascade", cascade::run),
        subcommand("analyse", analyse::run),
        subcommand("identify", identify::run),
        subcommand("methods", methods::run),
        subcommand("advise", advise::run),
    ]
}

/// Runs the subcommand given in the words of the command line, of which the first is the program's
/// name.
pub fn main(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let words: Vec<OsString> = words.into_iter().collect();
    let all = subcommands();
    let named = words.get(1).and_then(|word| word.to_str());
    if let Some(own) = all.iter().find(|own| Some(own.name) == named) {
        let first = OsString::from(format!("{NAME} {}", own.name));
        let rest = words.into_iter().skip(2);
        return (own.run)(std::iter::once(first).chain(rest).collect());
    }
    match command(all).try_get_matches_from(words) {
        Err(answer) => frame::answer(Some(answer)),
        Ok(matches) => {
            if let Some(shell) = matches
                .subcommand_matches(COMPLETIONS)
                .and_then(|matches| matches.get_one::<Shell>(SHELL))
            {
                let mut text = Vec::new();
                clap_complete::generate(*shell, &mut command(subcommands()), NAME, &mut text);
                return frame::write_out(&text);
            }
            ExitCode::SUCCESS
        }
    }
}

/// Returns the whole command, for its help text and for completions.
fn command(all: Vec<Subcommand>) -> Command {
    let completions = Command::new(COMPLETIONS)
        .about("Writes completions of the command for a shell")
        .arg(
            Arg::new(SHELL)
                .required(true)
                .value_parser(value_parser!(Shell)),
        );
    let own = all.into_iter();
    let own = own.map(|Subcommand { name, command, .. }| command.name(name));
    Command::new(NAME)
        .version(env!("CARGO_PKG_VERSION"))
        .about("Motions, modes, growth, energy transfers and measurements of a pendulum tree from a text file")
        .subcommands(own)
        .subcommand(completions)
        .subcommand_required(true)
        .arg_required_else_help(true)
        .disable_help_subcommand(true)
}
