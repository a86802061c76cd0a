//! What one evaluation of the accelerations costs.
//!
//! `evaluation-speed --help` says what is measured.

pub mod accuracy;
pub mod articulated;
pub mod by_hand;
pub mod dense;
pub mod large;
pub mod large_batches;
pub mod measure;
pub mod output;
mod random;
pub mod scenes;
pub mod states;
pub mod table;
#[cfg(test)]
mod tests;

use std::path::PathBuf;
use std::process::ExitCode;

use branched_pendulum_examples::exit;

const HELP: &str = "\
What do the accelerations of one state cost, in emitted code one by one and in
batches, against the system's sines and cosines alone, code written by hand for
the paper's pendulum, a recursion that takes any tree as a table, and the
textbook's dense matrix? How far is each from the truth? And what do large trees
cost, in loops, by the number of threads, and irregular ones, alone and in batches?

Usage: evaluation-speed [--output FOLDER]

  --output FOLDER  write the chart there, as evaluation-speed.svg and .png
  --help           this text
";

/// Passes over the states.
const REPEATS: usize = 301;

/// States at which errors are looked at.
const STATES: usize = 2000;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let folder = match words.as_slice() {
        [] => None,
        ["--help" | "-h"] => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        ["--output", folder] if !folder.is_empty() => Some(PathBuf::from(folder)),
        _ => {
            let message = "takes at most `--output FOLDER`";
            return exit::wrong_command_line("evaluation-speed", &message);
        }
    };
    let rows = measure::all(REPEATS);
    println!("{}", output::table(&rows));
    println!("{}", output::errors(&accuracy::all(STATES)));
    let large = large::all();
    print!("{}", large::tables(&large, &large::irregular()));
    print!("{}", large_batches::table(&large_batches::all()));
    exit::of_run(
        "evaluation-speed",
        match folder {
            Some(folder) => output::write(&folder, &rows, &large).map(drop),
            None => Ok(()),
        },
    )
}
