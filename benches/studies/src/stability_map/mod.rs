//! Maps of the region in which each method fails, by step and amplitude and by step and friction;
//! and maps of the region in which each truncated form of W fails.
//!
//! - [`verdict`]: classification of a run,
//! - [`output`]: table, CSV file and charts,
//! - [`truncation`]: forms of W against amplitude.

pub mod output;
pub mod truncation;
pub mod verdict;

use clap::Parser;

use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;

/// Maps where each method fails: runs the paper's branched double pendulum with
/// every method at many steps (or tolerances), amplitudes and frictions, and maps
/// what became of each run: accurate, bounded but wrong, drifting, diverged, or
/// refused with an error. Also maps the truncated forms of the energy transfer W:
/// accurate, bounded but wrong, or useless.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "stability-map", version, verbatim_doc_comment)]
pub struct Arguments {
    /// maps of which methods and forms to draw, by the names of their files;
    /// all by default
    #[arg(
        verbatim_doc_comment,
        long,
        value_name = "MAP",
        default_value = "all",
        value_parser = ["all", "amplitude", "tolerance", "friction", "truncation"]
    )]
    pub map: String,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("stability-map-output");
}

/// Computes the requested maps one after the other, each on all cores.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let requests = |name: &str| arguments.map == "all" || arguments.map == name;
    for survey in output::SURVEYS {
        if requests(survey.name) {
            output::deliver(job, &survey.map(job)?)?;
        }
    }
    if requests("truncation") {
        truncation::deliver(job, &truncation::map(job)?)?;
    }
    Ok(())
}
