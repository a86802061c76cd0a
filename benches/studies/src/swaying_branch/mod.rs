//! A branch of 31 links in real time: wind with gusts, a hand that pulls and lets go, and the cost
//! per frame and the error of each of its models.
//!
//! - [`arguments`]: the command line,
//! - [`scene`]: the branch,
//! - [`weather`]: wind and hand,
//! - [`motion`]: the models, advanced frame by frame, with their errors and costs,
//! - [`storm`]: a storm with strong blows,
//! - [`picture`]: the animated picture, [`report`]: table, frames and chart.

pub mod arguments;
pub mod motion;
pub mod picture;
pub mod report;
pub mod scene;
pub mod storm;
pub mod weather;

pub use arguments::Arguments;

use branched_pendulum_frame::Failure;
use branched_pendulum_frame::Job;
use motion::{Branches, reference};
use weather::Weather;

/// Simulates the branch with all models, and draws it.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let frame = 1.0 / arguments.frame_rate;
    let frames = (arguments.duration * arguments.frame_rate).round() as usize;
    let branches = Branches::new()?;
    let windy = Weather::new(arguments.wind, arguments.pull, arguments.seed);
    // One look, and the models in three winds.
    let progress = job.progress(4);
    progress.begin("frames");
    let seen = reference(&branches, &windy, frame, frames)?;
    report::write_frames(job, &seen)?;
    let film = picture::film(&branches.double, &seen, &windy)?;
    job.film("swaying-branch-animation", &film)?;
    progress.next();
    let mut trials = Vec::new();
    for share in motion::WINDS {
        progress.begin(&format!("{share} of the wind"));
        let weather = Weather::new(
            share * arguments.wind,
            share * arguments.pull,
            arguments.seed,
        );
        trials.push(motion::trial(&branches, &weather, share, frame, frames)?);
        progress.next();
    }
    report::write_trials(job, &trials)?;
    let storm = storm::run(&branches.single, arguments.storm, frame)?;
    for (name, value) in storm.account() {
        job.report(name, value);
    }
    job.print(&report::text(arguments, &branches, &trials, &storm))
}
