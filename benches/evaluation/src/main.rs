//! Program that measures the cost of one evaluation of the accelerations.
//!
//! `evaluation-speed --help` says what is measured.

pub mod accuracy;
pub mod agreement;
pub mod articulated;
pub mod by_hand;
pub mod dense;
pub mod large;
pub mod large_batches;
pub mod limit;
pub mod measure;
pub mod output;
pub mod scenes;
pub mod states;
pub mod table;

use std::process::ExitCode;

use branched_pendulum_frame as frame;
use clap::Parser;

/// Measures what the accelerations of one state cost, in emitted code one by one and in batches,
/// compared with the system's sines and cosines alone, code written by hand for the paper's
/// pendulum, a recursion that takes any tree as a table, and the textbook's dense matrix. How far
/// is each from the truth? And what do large trees cost, in loops, by the number of threads, and
/// irregular ones, alone and in batches?
#[derive(Parser)]
#[command(name = "evaluation-speed", version, verbatim_doc_comment)]
struct Arguments {
    /// checks that all implementations agree with emitted code, and measures nothing
    #[arg(long)]
    check: bool,
}

impl frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = None;
}

/// Passes over the states.
const REPEATS: usize = 301;

/// Number of states at which rounding errors are determined.
const STATES: usize = 2000;

fn main() -> ExitCode {
    frame::main(|arguments: &Arguments, job| {
        agreement::check().map_err(|disagreement| frame::Failure::Lacking {
            what: disagreement.to_string(),
        })?;
        if arguments.check {
            return job.print("All implementations agree.\n");
        }
        let progress = job.progress(4);
        job.report("seeds", states::SEEDS.to_vec());
        progress.begin("one state");
        let rows = measure::all(REPEATS);
        progress.next();
        job.print(&(output::table(&rows) + "\n"))?;
        job.print(&(limit::table(&rows) + "\n"))?;
        progress.begin("errors");
        let errors = accuracy::all(STATES);
        progress.next();
        job.print(&(output::errors(&errors) + "\n"))?;
        progress.begin("large trees");
        let large = large::full();
        let title = "Large trees in loops: least time for one link, ns.";
        job.print(&large::table(title, &large))?;
        let title = "Also irregular trees in a table.";
        job.print(&large::table(title, &large::irregular()))?;
        progress.next();
        progress.begin("large trees in batches");
        let batches = large_batches::all();
        progress.next();
        job.print(&large_batches::table(&batches))?;
        job.chart("evaluation-speed", &output::chart(&rows, &large))
    })
}
